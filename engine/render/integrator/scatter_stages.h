// Stages of scatter() (estimator.h) behind the BSDF: next event estimation, sampling of the next direction, Russian roulette.
#pragma once

#include "render/integrator/hit_stages.h"
#include "render/integrator/light_path_weights.h"
#include "render/integrator/mis_weights.h"
#include "render/kernels/stage_timer.h"
#include "shading/path_guiding.h"

#include <algorithm>

namespace blush::inline BLUSH_ISA {

// True if not black; NaN counts as light, so that it reaches the film and is reported.
template <class F> Mask<F> has_light(const Vec<F>& v) { return !(v.x <= F(0.f) && v.y <= F(0.f) && v.z <= F(0.f)); }

// This order propagates NaN.
template <class F> F limited_survival(const Roulette& r, const F& q) { return min(F(min(r.cap, 1.f)), max(F(r.floor), q)); }

// The learned adjoint may lack light that its pilot has not found. A path is no less likely to survive than this share of its throughput,
// so such light has at most the inverse of it times the weight that it has with `max`.
constexpr float least_adjoint_share = 0.1f;

// Survival probability of a path with throughput beta (render_settings.h has the rules); biased_cut gives 0 or 1.
template <class F> F survival_probability(const Roulette& r, const Vec<F>& beta) {
    F q = F(1.f);
    switch (r.rule) {
    case Roulette::Rule::off: return F(1.f);
    case Roulette::Rule::max: q = max_component(beta); break;
    case Roulette::Rule::luminance: q = luminance(beta); break;
    case Roulette::Rule::automatic: // these before they have been learned, and for paths that do not begin at the camera
    case Roulette::Rule::adjoint:
    case Roulette::Rule::efficiency:
    case Roulette::Rule::splitting:
    case Roulette::Rule::sqrt: q = sqrt(max_component(beta)); break;
    case Roulette::Rule::constant: q = F(r.probability); break;
    case Roulette::Rule::biased_cut: return select(max_component(beta) < F(r.threshold), F(0.f), F(1.f));
    }
    return limited_survival<F>(r, q);
}

// The same by the learned adjoint.
template <class F>
F adjoint_survival(const Roulette& r, const AdjointTables& adjoint, const Path<F>& path, const Receiver<F>& at, const Vec<F>& beta) {
    const F learned = luminance(beta) * path.importance * adjoint_value<F>(adjoint, at.position, at.normal);
    return limited_survival<F>(r, max(F(least_adjoint_share * max_component(beta)), learned));
}

// The share of paths that do not pass a pane straight through: thin_transmission.h handles its straight lobe. 1 elsewhere.
template <Features S, class F>
F share_beside_straight(const SceneTables& scene, const MaterialPoint<F>& material, const Bsdf<F>& bsdf, const Vec<F>& wo) {
    if constexpr (S.has(Feature::transmission))
        if (scene.panes) return select(material.pane, 1.f - straight_transmission<S, F>(bsdf, wo).probability, F(1.f));
    return F(1.f);
}
// Samples the others of its lobes. `lobe` selects one: less than that share, so that they keep their frequency.
template <Features S, class F>
[[gnu::always_inline]] inline BsdfSample<F> sample_beside_straight(const SceneTables& scene, const Bsdf<F>& bsdf, const Vec<F>& wo,
                                                                   const Mask<F>& pane, const F& lobe, const Pair<F>& direction) {
    BsdfSample<F> s = sample<S, F>(bsdf, wo, direction.x(), direction.y(), lobe);
    if constexpr (S.has(Feature::transmission))
        // rounding selected the straight lobe
        if (scene.panes) s.valid = s.valid && !(pane && s.delta && (s.wi.z > F(0.f)) != (wo.z > F(0.f)));
    return s;
}

// What sample_direct and sample_indirect share.
template <class F> struct ScatterSetup {
    Mask<F> pane;            // thin glass
    F scatter_share;         // share_beside_straight()
    bool guides;             // diffuse surfaces guide paths
    DirectionGuide<F> guide; // only if it has
    Receiver<F> receiver;
};
template <Features S, class F> [[gnu::always_inline]] inline ScatterSetup<F>
scatter_setup(const SceneTables& scene, const MaterialPoint<F>& material, const ShadingPoint<F>& p) {
    ScatterSetup<F> setup{
        material.pane, share_beside_straight<S, F>(scene, material, p.bsdf, p.shading.wo), false, {}, {p.surface.position, p.shading.ns}};
    // Kernels without specular lobes contain no code for caustic guiding.
    if constexpr (S.has(Feature::specular) || S.has(Feature::transmission)) {
        setup.guides = !scene.guides.empty();
        if (setup.guides) setup.guide = direction_guide_at<F>(scene.guides, p.surface.position, p.shading.ns, p.lambertian);
    }
    // Light from both sides.
    if constexpr (S.has(Feature::transmission))
        setup.receiver.normal = select<F>(material.bsdf.transmission > F(0.f), splat<F>(0.f), setup.receiver.normal);
    if constexpr (S.has(Feature::diffuse_transmission))
        setup.receiver.normal = select<F>(material.bsdf.layers.diffuse_transmission > F(0.f), splat<F>(0.f), setup.receiver.normal);
    return setup;
}

// Next event estimation with a point of one light: beta f |cos| L_e w_light / p_light, and the shadow ray that has to arrive
// (Veach 1997, 9.2). Not where all lobes are delta lobes. `random`: pair of light_dimension. `timer`: of the sampling of the light, may be
// null.
template <Features S, class F> [[gnu::always_inline]] inline void sample_direct(const SceneTables& scene, const MisSettings& mis,
                                                                                const ShadingPoint<F>& p, const ScatterSetup<F>& setup,
                                                                                const Pair<F>& random, SampledTimer* timer, Step<F>& out) {
    const Mask<F> wants_light = p.scatters && !is_delta_only<F>(p.bsdf);
    if (!any(wants_light)) return;
    if (timer) timer->begin();
    const LightPoint<F> light = sample_light_point<S, F>(scene, random, setup.receiver, wants_light);
    if (timer) timer->end();
    const Vec<F> rough_to = select<F>(light.infinite, light.position, light.position - p.surface.position);
    const Vec<F> from = offset_origin(p.surface.position, p.surface.error, p.shading.ng, dot(rough_to, p.shading.ng) > F(0.f));
    // Ends on this side of the light's plane, so that the light does not shadow itself.
    const Vec<F> end = offset_origin(light.position, light.error, light.normal, dot(rough_to, light.normal) < F(0.f));
    const Vec<F> to = select<F>(light.infinite, light.position, end - from);
    const F distance_squared = dot(to, to), distance = sqrt(distance_squared);
    const Vec<F> wi_world = to / distance;
    const Vec<F> wi = p.shading.frame.to_local(wi_world);
    const IncidentLight<F> in = incident_light<S, F>(scene, light, wi_world, distance_squared);
    const BsdfValue<F> f = eval<S, F>(p.bsdf, p.shading.wo, wi);
    Mask<F> only_sampled = light.delta, lit = Mask<F>(true);
    if constexpr (S.has(Feature::links)) {
        if (scene.links.lit_sets) {
            const Int<F> record = select(light.valid, light.light, Int<F>(0));
            lit = is_lit<F>(scene.links, record, p.surface.part, wants_light);
            only_sampled = only_sampled || has_own_shadows<F>(scene.links, record, wants_light);
            out.shadow_mask = shadow_mask<F>(scene.links, record);
        }
    }
    const F bsdf_pdf = setup.guides ? guided_pdf<F>(scene.guides, setup.guide, wi_world, f.pdf) : f.pdf;
    const F weight = nee_mis_weight<F>(mis, in.pdf, bsdf_pdf, only_sampled);
    out.direct = p.beta * f.f_cos * in.radiance * (weight / in.pdf);
    if constexpr (S.has(Feature::transmission))
        if (scene.panes) out.direct = out.direct * (1.f / max(setup.scatter_share, F(0x1p-24f)));
    out.light = light.light;
    if constexpr (S.has(Feature::light_paths))
        if (!scene.emission.empty()) out.sampled = light;
    out.weights.light = weight;
    out.weights.light_pdf = in.pdf;
    out.weights.light_bsdf_pdf = bsdf_pdf;
    // Light leaks: reject directions where the shading and the geometric normal disagree.
    const Mask<F> same_side = (wi.z > F(0.f)) == (dot(wi_world, p.shading.ng) > F(0.f));
    out.connects = light.valid && lit && same_side && has_light(out.direct);
    out.shadow = {from, wi_world};
    out.shadow_distance = select(light.infinite, F(infinity), distance * (1.f - 4e-7f));
    if constexpr (S.has(Feature::emissive_triangles))
        if (scene.lights.clearances)
            out.shadow_distance = distance_before_lamp<F>(scene.lights, light.light, from, wi_world, out.shadow_distance,
                                                          out.connects && dot(rough_to, light.normal) < F(0.f));
}

// A sampled direction of the path.
template <class F> struct IndirectSample {
    BsdfSample<F> bsdf; // wi in the shading frame
    Vec<F> wi;          // world
    F pdf_ratio;        // cosine pdf / pdf of the mixture with caustic guiding; 1 without
    Mask<F> outward;    // wi leaves to the side of ng
    F guided = F(0.f);  // share of guiding in the density of the mixture
};

// Caustic guiding: replaces the direction by one towards a caster with the guide's share, and the pdf by that of the mixture
// (one-sample model, Veach 1997, 9.2.4; caustic_guiding.h). `choice` has selected the lobe before.
template <class F> [[gnu::always_inline]] inline void guide_indirect(const SceneTables& scene, const ShadingPoint<F>& p,
                                                                     const DirectionGuide<F>& guide, const F& choice,
                                                                     const Pair<F>& direction, IndirectSample<F>& s) {
    const Mask<F> mixes = guide.share > F(0.f), guided = mixes && choice < guide.share;
    if (any(guided)) {
        const F which = min(F(choice / select(guided, guide.share, F(1.f))), F(one_minus_epsilon));
        s.wi = select<F>(guided, sample_guided_direction<F>(scene.guides, guide, which, direction.x(), direction.y()), s.wi);
        s.bsdf.wi = select<F>(guided, p.shading.frame.to_local(s.wi), s.bsdf.wi);
    }
    const F cosine = cosine_hemisphere_pdf(s.bsdf.wi.z);
    s.bsdf.valid = select(mixes, cosine > F(0.f), s.bsdf.valid);
    s.bsdf.pdf = select(mixes, guided_pdf<F>(scene.guides, guide, s.wi, cosine), s.bsdf.pdf);
    s.pdf_ratio = select(mixes && s.bsdf.valid, cosine / s.bsdf.pdf, F(1.f));
    s.bsdf.weight = select<F>(mixes, p.bsdf.diffuse * s.pdf_ratio, s.bsdf.weight);
    s.guided = select(mixes, min(max(F(1.f - (1.f - guide.share) * s.pdf_ratio), F(0.f)), F(1.f)), F(0.f));
}

// Samples wi with the BSDF or, on diffuse surfaces, towards a caustic caster; its weight is f |cos| / pdf. `choice` selects the
// lobe, `direction` (pair of bsdf_dimension) its direction.
template <Features S, class F>
[[gnu::always_inline]] inline IndirectSample<F> sample_indirect(const SceneTables& scene, const ShadingPoint<F>& p,
                                                                const ScatterSetup<F>& setup, const F& choice, const Pair<F>& direction) {
    F lobe = choice;
    if constexpr (S.has(Feature::transmission))
        if (scene.panes) lobe = lobe * setup.scatter_share;
    IndirectSample<F> s{sample_beside_straight<S, F>(scene, p.bsdf, p.shading.wo, setup.pane, lobe, direction), {}, F(1.f), {}, F(0.f)};
    s.wi = p.shading.frame.to_world(s.bsdf.wi);
    if (setup.guides && any(setup.guide.share > F(0.f))) guide_indirect<F>(scene, p, setup.guide, choice, direction, s);
    s.outward = dot(s.wi, p.shading.ng) > F(0.f);
    return s;
}

// Russian roulette (Arvo and Kirk 1990): the path survives with probability q, its throughput `beta` is divided by q. `u`: random
// number in [0, 1).
template <Features S, class F> [[gnu::always_inline]] inline void roulette(const SceneTables& scene, const EstimatorSettings& settings,
                                                                           const Path<F>& path, const ShadingPoint<F>& p,
                                                                           const Receiver<F>& receiver, const IndirectSample<F>& s,
                                                                           int bounce, const F& u, Vec<F>& beta, Step<F>& out) {
    if (bounce + 1 < std::max(settings.roulette.start, scene.roulette_start) || settings.roulette.rule == Roulette::Rule::off) return;
    // Undo the caustic guiding pdf: oversampled paths towards casters must not be ended for their low weight.
    Vec<F> rr_beta = beta * (1.f / s.pdf_ratio);
    if constexpr (S.has(Feature::transmission)) {
        // Refraction into a solid scales beta by 1 / ior^2, which is undone on exit: undo it here too.
        const F eta_squared = p.params.ior * p.params.ior;
        rr_beta = select<F>(p.solid && !s.outward && p.params.ior > F(0.f), rr_beta * eta_squared, rr_beta);
    }
    // Do not apply Russian roulette at delta lobes before bounce 17: such paths are likely caustic paths. A cap is needed for
    // scenes with delta lobes only.
    const Mask<F> rr_applied = !s.bsdf.delta || Mask<F>(bounce + 1 >= first_rr_bounce_at_delta);
    const F survival = scene.adjoint.empty() ? survival_probability(settings.roulette, rr_beta)
                                             : adjoint_survival<F>(settings.roulette, scene.adjoint, path, receiver, rr_beta);
    const F q = select(rr_applied, survival, F(1.f));
    out.weights.survival = q;
    out.weights.rr_applied = out.continues && rr_applied;
    out.continues = out.continues && !(u >= q);
    beta = beta / max(q, F(1e-30f));
}

// The path behind this vertex, with throughput `beta`. `cone`: texture footprint at the vertex (ray_cone.h).
template <Features S, class F> [[gnu::always_inline]] inline void next_path(const Path<F>& path, const ShadingPoint<F>& p,
                                                                            const ScatterSetup<F>& setup, const IndirectSample<F>& s,
                                                                            const Vec<F>& beta, const F& cone, Path<F>& next) {
    next.ray = {offset_origin(p.surface.position, p.surface.error, p.shading.ng, s.outward), normalize(s.wi)};
    next.beta = beta;
    next.pdf = select(s.bsdf.delta, F(infinity), s.bsdf.pdf);
    next.normal = setup.receiver.normal;
    next.key = path.key;
    next.index = path.index;
    next.slot = path.slot;
    next.importance = path.importance;
    next.light_ratio = next.emission_ratio = F(0.f);
    next.chain = Int<F>(0);
    if constexpr (S.has(Feature::links)) next.part = p.surface.part;
    if constexpr (S.has(Feature::dispersion)) next.dispersed = select(p.dispersed, Int<F>(1), Int<F>(0));
    if constexpr (S.has(Feature::textures)) {
        const Mask<F> flat = p.shading.ns.x == p.shading.ng.x && p.shading.ns.y == p.shading.ng.y && p.shading.ns.z == p.shading.ng.z;
        next.cone = scattered_cone<F>(cone, s.bsdf.delta, flat);
    }
}

// Path::chain behind this vertex.
template <Features S, class F> Int<F> chain_after(const SceneTables& scene, const Path<F>& path, const ShadingPoint<F>& p,
                                                  const IndirectSample<F>& s, const Step<F>& step, int bounce) {
    if (!samples_manifolds<S>(scene)) return Int<F>(0);
    const Mask<F> begins = step.reuse_vertex.begins_chains && starts_chains<S, F>(scene, path, bounce);
    const Mask<F> chains = has_chains<F>(scene, p.surface.material);
    return next_chain<F>(path.chain, {s.bsdf.delta, step.crosses, step.internal, chains, begins, p.lambertian},
                         Mask<F>(bounce > 0 && scene.manifolds.shares) && path.light_ratio > F(0.f));
}

// True if samples are weighted beside light paths (light_path_weights.h); the next three functions are for them.
template <Features S> bool connects_light_paths(const SceneTables& scene) {
    if constexpr (S.has(Feature::light_paths)) return !scene.emission.empty();
    return false;
}

// The ratio of densities at a vertex, before its own factor.
template <class F> F ratio_at_vertex(const SceneTables& scene, const EstimatorSettings& settings, const Path<F>& path,
                                     const ShadingPoint<F>& p, const Vec<F>& wo, const F& t, int bounce) {
    if (bounce > 0) return path.light_ratio;
    return F(scene.emission.paths) / (camera_density<F>(scene.camera, settings, -wo, t) * clamped_cosine<F>(p.shading.ng, wo));
}

// The density over projected solid angle with which a light path that comes along -wi goes on to wo.
template <class F> struct ReverseDensity {
    F density;    // if it comes from another surface; 1 at the first vertex, which it connects to the camera
    F from_light; // if it comes from its light; 0 at the first vertex
};
template <Features S, class F> ReverseDensity<F> reverse_density(const SceneTables& scene, const EnergyTable* energy,
                                                                 const ShadingPoint<F>& p, const MaterialPoint<F>& material,
                                                                 const Vec<F>& wo, const Vec<F>& wi, int bounce, const Mask<F>& active) {
    if (bounce == 0) return {F(1.f), F(0.f)};
    const ViewedPoint<F> view = view_point<S, F>(scene, energy, p.surface, material, p.bsdf, wi, wo, false, active);
    const F density = view.value.pdf / clamped_cosine<F>(p.shading.ng, wo);
    return {density, density * view.facet_share};
}

// Lowers the weight of NEE by the density of light paths, where they carry its light: behind the first vertex of the camera's path, by
// lobes that are not Lambertian.
template <Features S, class F>
[[gnu::noinline, gnu::flatten]] void weigh_direct(const SceneTables& scene, const EstimatorSettings& settings, const ShadingPoint<F>& p,
                                                  const MaterialPoint<F>& material, const Vec<F>& wo, const F& ratio, int bounce,
                                                  Step<F>& out) {
    if (bounce == 0) return;
    Mask<F> shared = out.connects && !p.lambertian && ratio > F(0.f);
    if constexpr (S.has(Feature::links))
        if (scene.links.lit_sets) shared = shared && !has_own_shadows<F>(scene.links, out.sampled.light, shared);
    if (!any(shared)) return;
    const Vec<F>& wi = out.shadow.direction;
    const LightPoint<F>& light = out.sampled;
    const Vec<F> to = light.position - p.surface.position;
    const Mask<F> point = light.delta && !light.infinite;
    const auto at =
        emission_point<S, F>(scene, light.light, select<F>(light.infinite, p.surface.position, light.position), light.normal, wi, shared);
    const F emitted = emission_density<F>(scene.emission, at, shared);
    // The pdf of NEE over projected solid angle; a point light has a probability, which counts per area that faces it.
    const F nee = out.weights.light_pdf * select(point, dot(to, to), F(1.f)) / clamped_cosine<F>(p.shading.ng, wi);
    const F reverse = reverse_density<S, F>(scene, settings.energy, p, material, wo, wi, bounce, shared).from_light;
    const F beside = weight_beside(out.weights.light, F(ratio * reverse * emitted / nee));
    out.direct = select<F>(shared, out.direct * (beside / out.weights.light), out.direct);
    out.weights.light = select(shared, beside, out.weights.light);
}

// The ratios of the path behind this vertex.
template <Features S, class F>
[[gnu::noinline, gnu::flatten]] void continue_ratios(const SceneTables& scene, const EstimatorSettings& settings, const ShadingPoint<F>& p,
                                                     const MaterialPoint<F>& material, const Vec<F>& wo, const IndirectSample<F>& s,
                                                     const F& ratio, int bounce, Path<F>& next) {
    const Mask<F> dense = p.scatters && !s.bsdf.delta;
    F factor = F(bounce == 0 ? 0.f : 1.f); // a light path is not connected to the camera at a delta lobe
    F of_emission = factor;
    if (any(dense)) {
        const F forward = s.bsdf.pdf / clamped_cosine<F>(p.shading.ng, s.wi), inverse = 1.f / max(forward, F(1e-30f));
        const ReverseDensity<F> reverse = reverse_density<S, F>(scene, settings.energy, p, material, wo, s.wi, bounce, dense);
        factor = select(dense, select(forward > F(0.f), reverse.density * inverse, F(0.f)), factor);
        of_emission = select(dense, select(forward > F(0.f), reverse.from_light * inverse, F(0.f)), of_emission);
    }
    next.light_ratio = min(F(ratio * factor), F(1e30f));
    next.emission_ratio = min(F(ratio * of_emission), F(1e30f));
}

} // namespace blush::inline BLUSH_ISA
