// The estimator of the rendering equation (Kajiya 1986), one step at a time: unidirectional path tracing and
// next event estimation, combined by multiple importance sampling (Veach 1997), and Russian roulette. Written once for any lane type.
#pragma once

#include "render/integrator/camera.h"
#include "render/integrator/estimator_settings.h"
#include "render/integrator/hit_stages.h"
#include "render/integrator/links.h"
#include "render/integrator/path.h"
#include "render/integrator/ray_cone.h"
#include "render/integrator/scatter_stages.h"

namespace blush::inline BLUSH_ISA {

// Dimensions of the sampler in pairs: 0 pixel filter, 1 lens, then three for each scattering event.
constexpr uint32_t first_scatter_dimension = 2;
enum ScatterDimension : uint32_t { light_dimension, bsdf_dimension, choice_dimension, dimensions_per_scatter };

template <Features S, class F> Path<F> begin_path(const SceneTables& scene, const EstimatorSettings& settings, const F& x, const F& y,
                                                  const Sampler<F>& sampler, const Int<F>& slot) {
    const Pair<F> in_pixel = sampler.pair(0);
    const F px = x + 0.5f + filter_offset(*settings.filter, in_pixel.x());
    const F py = y + 0.5f + filter_offset(*settings.filter, in_pixel.y());
    F lens_u = F(0.f), lens_v = F(0.f);
    if constexpr (S.has(Feature::thin_lens)) {
        const Pair<F> on_lens = sampler.pair(1);
        lens_u = on_lens.x();
        lens_v = on_lens.y();
    }
    Path<F> path;
    path.ray = camera_ray<S, F>(scene.camera, px, py, settings.width, settings.height, lens_u, lens_v);
    path.beta = splat<F>(1.f);
    path.pdf = F(infinity);
    path.normal = splat<F>(0.f);
    path.key = sampler.key;
    path.index = sampler.index;
    path.slot = slot;
    path.importance = scene.adjoint.empty() ? F(1.f) : pixel_importance<F>(scene.adjoint, x, y);
    path.part = Int<F>(from_camera);
    path.dispersed = Int<F>(0);
    path.light_ratio = path.emission_ratio = F(0.f);
    path.chain = Int<F>(0);
    path.cone = F(0.f);
    if constexpr (S.has(Feature::textures)) path.cone = cone_at_camera<F>(scene.camera, settings);
    return path;
}

// A step that neither adds light nor continues.
template <class F> Step<F> ended_step(const Vec<F>& beta) {
    Step<F> step;
    step.emitted = splat<F>(0.f);
    step.light = Int<F>(0);
    step.connects = step.continues = step.non_finite = step.crosses = step.internal = Mask<F>(false);
    step.weights = {F(1.f), F(1.f), F(0.f), F(0.f), F(1.f), Mask<F>(false), beta};
    return step;
}

// Shades one vertex of the path: `hit` is the hit of path.ray. Lanes outside `active` are ignored. The stages are in hit_stages.h
// and scatter_stages.h. `light_timer` measures the sampling of a light; null: not measured.
template <Features S, class F> Step<F> scatter(const SceneTables& scene, const EstimatorSettings& settings, const Path<F>& path,
                                               const Hit<F>& hit, int bounce, const Mask<F>& active, SampledTimer* light_timer = nullptr) {
    Step<F> out = ended_step<F>(path.beta);
    const Mask<F> met = active && as_mask(hit.geometry >= 0);
    hit_background<S, F>(scene, settings, path, bounce, active && !met, out);
    const HitLanes<F> lanes = hit_sphere_light<S, F>(scene, settings.mis, path, hit, met, out);

    // The surface and its material.
    F cone = F(0.f);
    if constexpr (S.has(Feature::textures)) cone = cone_width<F>(scene.camera, settings, path, hit.t);
    const F width = filter_width<S, F>(scene, hit, cone, bounce, lanes.surface);
    const Surface<F> surface = surface_at<S, F>(scene, hit, lanes.surface, width);
    MaterialPoint<F> material = material_at<S, F>(scene.materials, surface.material, surface.texture, surface.color, lanes.surface);
    const HitSide<F> side = hit_side<S, F>(surface, material, path.ray.direction);

    Vec<F> beta = attenuate<S, F>(path.beta, material, hit.t, side, lanes.surface);
    out.weights.arriving = beta;
    hit_emitter<S, F>(scene, settings.mis, path, hit, surface, material, side, beta, lanes.surface, out);
    const Mask<F> scatters = hit_unlit<S, F>(material, beta, lanes.surface, out);
    const ShadingFrame<F> shading = shading_frame_at<S, F>(surface, material, side.wo, side.front, side.solid);
    const Mask<F> dispersed = disperse<S, F>(path, material.dispersion, side, scatters, material.bsdf.ior, beta);
    const Bsdf<F> bsdf = make_bsdf<S, F>(material.bsdf, shading.wo, settings.energy);
    const ShadingPoint<F> p{surface,    material.bsdf, shading, bsdf, beta, scatters, scatters && is_lambertian<S, F>(bsdf),
                            side.solid, dispersed};
    if (bounce == 0) first_hit_planes<S, F>(scene, hit, lanes, p, side.wo, out.emitted, out.first);
    if (bounce <= 1 || samples_manifolds<S>(scene)) set_reuse_vertex<F>(p, out.reuse_vertex);
    if (samples_manifolds<S>(scene))
        out.reuse_vertex.begins_chains = scatters && !shading.behind && only_reflects<S, F>(bsdf, material.bsdf);
    if (bounce >= settings.max_bounces) return out;

    const Sampler<F> sampler{path.key, path.index};
    const uint32_t dimension = first_scatter_dimension + dimensions_per_scatter * uint32_t(bounce);
    const ScatterSetup<F> setup = scatter_setup<S, F>(scene, material, p);
    if (scene.lights.count > 0 || scene.lights.portals.rows)
        sample_direct<S, F>(scene, settings.mis, p, setup, sampler.pair(dimension + light_dimension), light_timer, out);
    const bool beside = connects_light_paths<S>(scene);
    const F light_ratio = beside ? ratio_at_vertex<F>(scene, settings, path, p, side.wo, hit.t, bounce) : F(0.f);
    if (beside) weigh_direct<S, F>(scene, settings, p, material, side.wo, light_ratio, bounce, out);

    const Pair<F> choice = sampler.pair(dimension + choice_dimension);
    const Pair<F> direction = sampler.pair(dimension + bsdf_dimension);
    const IndirectSample<F> indirect = sample_indirect<S, F>(scene, p, setup, choice.x(), direction);
    Vec<F> next_beta = p.beta * indirect.bsdf.weight;
    // Light leaks: reject directions where the shading and the geometric normal disagree.
    const Mask<F> same_side = (indirect.bsdf.wi.z > F(0.f)) == indirect.outward;
    out.continues = scatters && indirect.bsdf.valid && same_side && has_light(next_beta);
    out.weights.guided = indirect.guided;
    roulette<S, F>(scene, settings, path, p, setup.receiver, indirect, bounce, choice.y(), next_beta, out);
    out.non_finite = out.continues && !is_finite(F(next_beta.x + next_beta.y + next_beta.z));
    out.continues = out.continues && !out.non_finite;
    out.crosses = indirect.outward != (dot(side.wo, p.shading.ng) > F(0.f));
    out.internal = reflects_partly_within<S, F>(side, bsdf, out.crosses);
    next_path<S, F>(path, p, setup, indirect, next_beta, cone, out.next);
    if constexpr (S.has(Feature::light_paths)) out.next.chain = chain_after<S, F>(scene, path, p, indirect, out, bounce);
    if (beside) continue_ratios<S, F>(scene, settings, p, material, side.wo, indirect, light_ratio, bounce, out.next);
    return out;
}

} // namespace blush::inline BLUSH_ISA
