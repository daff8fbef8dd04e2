#include "render/biased/diffuse_points.h"

#include "render/film/first_surfaces.h"
#include "render/integrator/wavefront.h"

#include <optional>

namespace blush {
namespace {

constexpr Features features = all_features;

// Reflectance of the diffuse part of the surface in the direction of the path; black if there is none.
std::optional<DiffusePoint> diffuse_point(const KernelContext& context, const Path<float>& path, const Hit<float>& hit) {
    const SceneTables& scene = *context.scene;
    const float cone = cone_width<float>(scene.camera, context.settings, path, hit.t);
    const Surface<float> surface = surface_at<features, float>(scene, hit, true, filter_width<features, float>(scene, hit, cone, 0, true));
    MaterialPoint<float> material = material_at<features, float>(scene.materials, surface.material, surface.texture, surface.color, true);
    if (material.unlit) return std::nullopt;
    const HitSide<float> side = hit_side<features, float>(surface, material, path.ray.direction);
    const Vec3 beta = attenuate<features, float>(path.beta, material, hit.t, side, true);
    const ShadingFrame<float> shading = shading_frame_at<features, float>(surface, material, side.wo, side.front, side.solid);
    const Bsdf<float> bsdf = make_bsdf<features, float>(material.bsdf, shading.wo, context.settings.energy);
    const Vec3 reflects = beta * bsdf.diffuse * inv_pi;
    if (!(max_component(reflects) > 0)) return std::nullopt;
    const MeterPoint receiver{offset_origin<float>(surface.position, surface.error, shading.ng, true), shading.ns};
    return DiffusePoint{receiver, reflects, {path.key, path.index}, path.slot};
}

} // namespace

void find_diffuse_points(const KernelContext& context, const TileJob& job, TileScratch& scratch, std::vector<DiffusePoint>& points) {
    points.clear();
    generate_paths<features, float>(context, job, scratch);
    trace_first_surfaces(context, camera_ray_mask, scratch);
    for (int k = 0; k < job.paths(); ++k) {
        const Hit<float> hit = load_hit<float>(scratch.hits, k);
        if (hit.geometry < 0 || hit.instance == sphere_instance) continue;
        if (const auto point = diffuse_point(context, load_path<features, float>(scratch.paths[0], k), hit)) points.push_back(*point);
    }
}

} // namespace blush
