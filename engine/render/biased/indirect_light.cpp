#include "render/biased/indirect_light.h"

#include "render/biased/ambient_light.h"
#include "render/biased/irradiance_cache.h"
#include "render/biased/light_probes.h"
#include "render/integrator/first_surfaces.h"
#include "render/integrator/wavefront.h"
#include "scene/affine.h"

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

TileScratch& PreparationContext::scratch_of(unsigned worker) const {
    if (!scratch[worker]) scratch[worker] = std::make_unique<TileScratch>();
    return *scratch[worker];
}

std::unique_ptr<IndirectLight> make_indirect_light(const BiasedIntegrator& integrator) {
    switch (integrator.kind) {
    case BiasedIntegrator::Kind::none: break;
    case BiasedIntegrator::Kind::ambient: return std::make_unique<AmbientLight>(integrator);
    case BiasedIntegrator::Kind::irradiance_cache: return std::make_unique<IrradianceCache>(integrator);
    case BiasedIntegrator::Kind::light_probes: return std::make_unique<LightProbes>(integrator);
    }
    return nullptr;
}

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
