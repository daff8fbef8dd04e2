#include "render/film/first_surfaces.h"

#include "render/integrator/wavefront.h"

namespace blush {

void trace_first_surfaces(const KernelContext& context, uint32_t mask, TileScratch& tile) {
    const PathQueue& q = tile.paths[0];
    const bool blends = context.scene->blends;
    if (blends)
        for (int k = 0; k < q.size; ++k) tile.random[k] = opacity_random<float>(q.key[k], q.index[k], 0);
    const RayArrays rays{q.ox, q.oy, q.oz, q.dx, q.dy, q.dz, nullptr, blends ? tile.random.data : nullptr, mask};
    HitColumns& h = tile.hits;
    context.accel->intersect(rays, q.size, true, {h.t, h.u, h.v, h.geometry, h.instance, h.triangle});
}

} // namespace blush
