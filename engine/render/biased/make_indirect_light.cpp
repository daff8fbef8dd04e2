#include "render/biased/make_indirect_light.h"

#include "render/biased/ambient_light.h"
#include "render/biased/irradiance_cache.h"
#include "render/biased/light_probes.h"
#include "render/biased/photon_map.h"
#include "scene/affine.h"

namespace blush {

std::unique_ptr<IndirectLight> make_indirect_light(const BiasedIntegrator& integrator) {
    switch (integrator.kind) {
    case BiasedIntegrator::Kind::none: break;
    case BiasedIntegrator::Kind::ambient: return std::make_unique<AmbientLight>(integrator);
    case BiasedIntegrator::Kind::irradiance_cache: return std::make_unique<IrradianceCache>(integrator);
    case BiasedIntegrator::Kind::light_probes: return std::make_unique<LightProbes>(integrator);
    case BiasedIntegrator::Kind::photon_map: return std::make_unique<PhotonMap>(integrator);
    }
    return nullptr;
}

void add_indirect_light(const KernelContext& context, const IndirectLight& light, const TileJob& job, TileScratch& tile,
                        TileScratch& scratch) {
    std::vector<DiffusePoint> points;
    find_diffuse_points(context, job, scratch, points);
    std::vector<Vec3d> irradiance(points.size());
    light.irradiance(context, points, scratch, irradiance);
    for (size_t i = 0; i < points.size(); ++i) {
        const int slot = points[i].slot;
        const Vec3d reflected = irradiance[i] * to_double(points[i].reflects);
        tile.r[slot] += reflected.x;
        tile.g[slot] += reflected.y;
        tile.b[slot] += reflected.z;
    }
}

} // namespace blush
