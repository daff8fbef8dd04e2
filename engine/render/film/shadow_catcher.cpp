#include "render/film/shadow_catcher.h"

#include "render/film/first_surfaces.h"
#include "render/integrator/irradiance.h"
#include "render/integrator/wavefront.h"

#include <algorithm>

namespace blush {
namespace {

constexpr Features features = all_features;

// Queues a shadow ray if a light may reach the surface. Returns its unoccluded luminance.
float queue_catcher_shadow_ray(const KernelContext& context, const Surface<float>& surface, const Vec3& direction, const Path<float>& path,
                               TileScratch& tile) {
    const bool front = dot(surface.ng, direction) < 0;
    const Vec3 ng = front ? surface.ng : -surface.ng;
    const Vec3 ns = dot(surface.ns, ng) > 0 ? surface.ns : -surface.ns;
    const MeterPoint receiver{offset_origin<float>(surface.position, surface.error, ng, true), ns};
    const Step<float> step = sample_light_at_meter(context, receiver, Sampler<float>{path.key, path.index}, surface.part);
    if (!step.connects || !(dot(step.shadow.direction, ng) > 0)) return 0;
    ShadowQueue& q = tile.shadows;
    if (context.scene->blends) q.random[q.size] = opacity_random<float>(path.key, path.index, 1);
    q.mask[q.size] = step.shadow_mask;
    append<float>(q, step, path.slot, true);
    return luminance(step.direct);
}

// Light blocked by other catchers is in neither sum. Lights with linked shadow casters do not exclude catchers either.
void drop_shadows_of_catchers(const KernelContext& context, CatcherScratch& scratch) {
    TileScratch& tile = scratch.tile;
    ShadowQueue& q = tile.shadows;
    Column<uint32_t>& masks = tile.random;
    for (int k = 0; k < q.size; ++k) masks[k] = q.mask[k] == other_ray_mask ? catcher_ray_mask : 0;
    RayArrays rays = shadow_rays_of(context, q);
    rays.masks = masks.data;
    rays.random = nullptr;
    float* share = tile.hits.t; // free: the hits' surfaces are known
    context.accel->transmittance(rays, q.size, true, share);
    // The other sum is that of connect_paths(), whose rays meet catchers like all objects.
    for (int k = 0; k < q.size; ++k) scratch.columns.unoccluded[q.slot[k]] *= share[k];
}

} // namespace

void catch_shadows(KernelContext context, std::span<const uint8_t> is_catcher, const TileJob& job, CatcherScratch& scratch) {
    context.settings.mis.strategy = Strategy::light; // all light by NEE: emission at ray hits is not counted
    context.settings.reuse = {};
    TileScratch& tile = scratch.tile;
    CatcherColumns& out = scratch.columns;
    generate_paths<features, float>(context, job, tile);
    trace_first_surfaces(context, camera_ray_mask | catcher_ray_mask, tile);
    const int paths = job.paths();
    std::fill_n(out.caught.data, paths, uint8_t(0));
    std::fill_n(out.unoccluded.data, paths, 0.f);
    std::fill_n(out.arriving.data, paths, 0.f);
    tile.shadows.size = 0;
    for (int k = 0; k < paths; ++k) {
        const Hit<float> hit = load_hit<float>(tile.hits, k);
        if (hit.geometry < 0 || hit.instance == sphere_instance) continue;
        if (!is_catcher[size_t(part_of<features, float>(*context.scene, hit, true))]) continue;
        const Path<float> path = load_path<features, float>(tile.paths[0], k);
        out.caught[path.slot] = 1;
        if (context.scene->lights.count == 0) continue;
        out.unoccluded[path.slot] =
            queue_catcher_shadow_ray(context, surface_at<features, float>(*context.scene, hit, true), path.ray.direction, path, tile);
    }
    if (tile.shadows.size == 0) return;
    drop_shadows_of_catchers(context, scratch);
    tile.shadow_rays += tile.shadows.size;
    connect_paths<features, float>(context, tile, 0);
    for (int slot = 0; slot < paths; ++slot)
        if (out.unoccluded[slot] > 0) out.arriving[slot] = luminance(Vec3{float(tile.r[slot]), float(tile.g[slot]), float(tile.b[slot])});
}

} // namespace blush
