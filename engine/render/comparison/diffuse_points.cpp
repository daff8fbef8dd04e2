#include "render/comparison/diffuse_points.h"

#include "render/comparison/hit_shading.h"
#include "render/film/first_surfaces.h"
#include "render/integrator/wavefront.h"

#include <optional>

namespace blush {
namespace {

// Reflectance of the diffuse part of the surface in the direction of the path; none if that is black.
std::optional<DiffusePoint> diffuse_point(const KernelContext& context, const Path<float>& path, const Hit<float>& hit) {
    const float cone = cone_width<float>(context.scene->camera, context.settings, path, hit.t);
    const HitShading p = shade_hit(context, path, hit, filter_width<all_features, float>(*context.scene, hit, cone, 0, true));
    if (!p.scatters) return std::nullopt;
    const Vec3 reflects = p.beta * p.bsdf.diffuse * inv_pi;
    if (!(max_component(reflects) > 0)) return std::nullopt;
    const MeterPoint receiver{offset_origin<float>(p.surface.position, p.surface.error, p.shading.ng, true), p.shading.ns};
    return DiffusePoint{receiver, reflects, {path.key, path.index}, path.slot};
}

} // namespace

void find_diffuse_points(const KernelContext& context, const TileJob& job, TileScratch& scratch, std::vector<DiffusePoint>& points) {
    points.clear();
    generate_paths<all_features, float>(context, job, scratch);
    trace_first_surfaces(context, camera_ray_mask, scratch);
    for (int k = 0; k < job.paths(); ++k) {
        const Hit<float> hit = load_hit<float>(scratch.hits, k);
        if (hit.geometry < 0 || hit.instance == sphere_instance) continue;
        Path<float> path = load_path<all_features, float>(scratch.paths[0], k);
        path.dispersed = 0;
        if (const auto point = diffuse_point(context, path, hit)) points.push_back(*point);
    }
}

} // namespace blush
