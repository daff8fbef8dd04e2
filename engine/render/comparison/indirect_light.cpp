#include "render/comparison/indirect_light.h"

#include "scene/affine.h"

namespace blush {

TileScratch& PreparationContext::scratch_of(unsigned worker) const {
    if (!scratch[worker]) scratch[worker] = std::make_unique<TileScratch>();
    return *scratch[worker];
}

void IndirectLight::add(const KernelContext& context, const TileJob& job, TileScratch& tile, TileScratch& scratch) const {
    std::vector<DiffusePoint> points;
    find_diffuse_points(context, job, scratch, points);
    std::vector<Vec3d> arriving(points.size());
    irradiance(context, points, scratch, arriving);
    for (size_t i = 0; i < points.size(); ++i) {
        const int slot = points[i].slot;
        const Vec3d reflected = arriving[i] * to_double(points[i].reflects);
        tile.r[slot] += reflected.x;
        tile.g[slot] += reflected.y;
        tile.b[slot] += reflected.z;
    }
}

} // namespace blush
