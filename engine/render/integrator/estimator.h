// The estimator of the rendering equation (Kajiya 1986), one step at a time: unidirectional path tracing with next-event
// estimation, both combined by multiple importance sampling (Veach 1997), and Russian roulette. Written once for any lane type.
#pragma once

#include "render/integrator/camera.h"
#include "render/integrator/dispersion.h"
#include "render/integrator/emission_hit.h"
#include "render/integrator/estimator_settings.h"
#include "render/integrator/light_sampling.h"
#include "render/integrator/links.h"
#include "render/integrator/path.h"
#include "render/integrator/ray_cone.h"
#include "render/integrator/shading_frame.h"
#include "shading/bsdf.h"
#include "shading/caustic_guiding.h"

namespace blush::inline BLUSH_ISA {

// Dimensions of the sampler in pairs: 0 pixel filter, 1 lens, then three for each scattering event.
constexpr uint32_t first_scatter_dimension = 2;
enum ScatterDimension : uint32_t { light_dimension, bsdf_dimension, choice_dimension, dimensions_per_scatter };

// MIS weight of NEE; delta lights cannot be hit, so their weight is always 1.
template <class F> F nee_mis_weight(Strategy strategy, const F& light_pdf, const F& bsdf_pdf, const Mask<F>& delta) {
    if (strategy == Strategy::bsdf) return select(delta, F(1.f), F(0.f));
    if (strategy == Strategy::light) return F(1.f);
    return select(delta, F(1.f), power_heuristic(light_pdf, bsdf_pdf));
}

// Texture footprint (metres) at panes. Only camera rays filter: elsewhere a pane's transmittance is compared with that seen by
// shadow rays, which do not filter textures.
template <class F> F pane_width(const F& cone, int bounce) { return bounce == 0 ? cone : F(0.f); }

// True if not black; NaN counts as light, so that it reaches the film and is reported.
template <class F> Mask<F> has_light(const Vec<F>& v) { return !(v.x <= F(0.f) && v.y <= F(0.f) && v.z <= F(0.f)); }

// Survival probability of a path with throughput beta (render_settings.h has the rules); biased_cut gives 0 or 1.
template <class F> F survival_probability(const Roulette& r, const Vec<F>& beta) {
    F q = F(1.f);
    switch (r.rule) {
    case Roulette::Rule::off: return F(1.f);
    case Roulette::Rule::max: q = max_component(beta); break;
    case Roulette::Rule::luminance: q = luminance(beta); break;
    case Roulette::Rule::sqrt: q = sqrt(max_component(beta)); break;
    case Roulette::Rule::constant: q = F(r.probability); break;
    case Roulette::Rule::biased_cut: return select(max_component(beta) < F(r.threshold), F(0.f), F(1.f));
    }
    return min(F(min(r.cap, 1.f)), max(F(r.floor), q)); // this order propagates NaN
}

template <Features S, class F> Path<F> begin_path(const SceneTables& scene, const EstimatorSettings& settings, const F& x, const F& y,
                                                  const UInt<F>& key, const UInt<F>& index, const Int<F>& slot) {
    const Sampler<F> sampler{key, index};
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
    path.key = key;
    path.index = index;
    path.slot = slot;
    path.part = Int<F>(from_camera);
    path.dispersed = Int<F>(0);
    path.cone = F(0.f);
    if constexpr (S.has(Feature::textures)) path.cone = cone_at_camera<F>(scene.camera, settings);
    return path;
}

// Shades one vertex of the path: `hit` is the hit of path.ray. Lanes outside `active` are ignored.
template <Features S, class F> Step<F> scatter(const SceneTables& scene, const EstimatorSettings& settings, const Path<F>& path,
                                               const Hit<F>& hit, int bounce, const Mask<F>& active) {
    Step<F> out;
    out.emitted = splat<F>(0.f);
    out.light = Int<F>(0);
    out.connects = out.continues = out.non_finite = Mask<F>(false);
    out.weights = {F(1.f), F(1.f), F(0.f), F(0.f), F(1.f), Mask<F>(false), path.beta};
    const Mask<F> met = active && as_mask(hit.geometry >= 0);
    const Mask<F> escaped = active && !met;
    Mask<F> found = met; // hit a surface with a material
    Vec<F> beta = path.beta;

    // The ray escaped: environment and suns.
    if constexpr (S.has(Feature::environment) || S.has(Feature::suns)) {
        if (any(escaped)) {
            const BackgroundLight<F> light = background_light<S, F>(scene, settings, path, bounce, escaped);
            out.emitted = select<F>(escaped, beta * light.radiance, out.emitted);
            out.weights.emission = light.weight;
        }
    }
    out.emits = escaped;

    // Sphere lights reflect nothing: the path ends.
    Mask<F> on_sphere = Mask<F>(false);
    Int<F> sphere_object = Int<F>(0);
    if constexpr (S.has(Feature::sphere_lights)) {
        on_sphere = met && as_mask(hit.instance == sphere_instance);
        if (any(on_sphere)) {
            const SphereEmissionHit<F> sphere = sphere_emission_hit<S, F>(scene, settings.strategy, path, hit.triangle, on_sphere);
            out.emitted = select<F>(on_sphere, beta * sphere.radiance, out.emitted);
            out.weights.emission = select(on_sphere, sphere.weight, out.weights.emission);
            out.emits = out.emits || on_sphere;
            sphere_object = select(on_sphere, sphere.object, sphere_object);
            found = met && !on_sphere;
        }
    }

    // The surface and its material.
    F cone = F(0.f);
    if constexpr (S.has(Feature::textures)) cone = cone_width<F>(scene.camera, settings, path, hit.t);
    F width = cone;
    if constexpr (S.has(Feature::transmission) && S.has(Feature::textures))
        if (scene.panes) width = select(is_pane<S, F>(scene, hit, found), pane_width<F>(cone, bounce), cone);
    const Surface<F> surface = surface_at<S, F>(scene, hit, found, width);
    const MaterialPoint<F> material = material_at<S, F>(scene.materials, surface.material, surface.texture, surface.color, found);
    const Vec<F> wo_world = -path.ray.direction;
    const F outside = dot(surface.ng, wo_world);
    const Mask<F> front = outside > F(0.f);
    Mask<F> solid = Mask<F>(false);
    if constexpr (S.has(Feature::transmission)) solid = is_solid<S, F>(material.bsdf);

    // Absorption along the segment that ends here from within (Beer-Lambert).
    if constexpr (S.has(Feature::absorption)) {
        const Mask<F> within = found && solid && !front;
        if (any(within)) {
            const Vec<F> optical_depth = material.sigma_a * hit.t;
            const Vec<F> passed{blush::exp(-optical_depth.x), blush::exp(-optical_depth.y), blush::exp(-optical_depth.z)};
            beta = select<F>(within, beta * passed, beta);
            out.weights.arriving = beta;
        }
    }

    // Emission at the hit.
    Mask<F> scatters = found;
    if constexpr (S.has(Feature::emissive_triangles)) {
        const Mask<F> emitting = found && max_component(material.emission) > F(0.f) && (front || material.double_sided);
        if (any(emitting)) {
            Vec<F> emission = material.emission;
            if constexpr (S.has(Feature::clearcoat))
                emission = emission * through_clearcoat(material.bsdf.layers.clearcoat, F(abs(outside)));
            const EmissionHit<F> light =
                emission_hit<S, F>(scene, settings.strategy, path, surface.part, hit, abs(outside), emission, emitting);
            out.emitted = select<F>(emitting, beta * light.radiance * light.weight, out.emitted);
            out.weights.emission = select(emitting, light.weight, out.weights.emission);
            out.emits = out.emits || emitting;
        }
    }
    if constexpr (S.has(Feature::unlit)) {
        // Unlit: every ray sees the surface's colour; it neither scatters nor is sampled as a light.
        const Mask<F> unlit = found && material.unlit;
        out.emitted = select<F>(unlit, beta * material.bsdf.base_color, out.emitted);
        out.emits = out.emits || unlit;
        scatters = scatters && !unlit;
    }

    const ShadingFrame<F> shading = shading_frame_at<S, F>(surface, material, wo_world, front, solid);
    const Vec<F>&ng = shading.ng, &ns = shading.ns, &wo = shading.wo;
    const Basis<F>& frame = shading.frame;
    BsdfParams<F> params = shading.params;
    Mask<F> dispersed = Mask<F>(false);
    if constexpr (S.has(Feature::dispersion)) {
        dispersed = as_mask(path.dispersed != 0);
        const Mask<F> splits = scatters && solid && material.dispersion > F(0.f);
        if (any(splits)) {
            const Wavelength<F> light = wavelength_of(Sampler<F>{path.key, path.index});
            params.ior = select(splits, dispersed_ior(params.ior, material.dispersion, light.nanometres), params.ior);
            beta = select<F>(splits && !dispersed, beta * light.rgb, beta);
            dispersed = dispersed || splits;
        }
    }
    const auto bsdf = make_bsdf<S, F>(params, wo, settings.energy);
    const Mask<F> matte = scatters && is_lambertian<S, F>(bsdf);

    if (bounce == 0) {
        out.first.albedo = select<F>(found, albedo<S, F>(bsdf, wo), out.emitted);
        out.first.normal = select<F>(found, ns, select<F>(on_sphere, wo_world, splat<F>(0.f)));
        out.first.depth = select(met, hit.t, F(0.f));
        out.first.object = select(found, gather_field(scene.parts, &PartRecord::object, surface.part), sphere_object);
        out.first.material = select(found, surface.material, Int<F>(-1));
    }
    if (bounce <= 1) {
        out.reuse_vertex.lambertian = matte && !shading.behind;
        out.reuse_vertex.position = surface.position;
        out.reuse_vertex.clearance = clearance(ng, surface.error);
        out.reuse_vertex.ng = ng;
        out.reuse_vertex.ns = ns;
        out.reuse_vertex.reflectance = bsdf.diffuse;
    }
    if (bounce >= settings.max_bounces) return out;

    // Share of paths that do not pass the pane straight through (those that pass are handled in thin_transmission.h).
    F scatter_share = F(1.f);
    if constexpr (S.has(Feature::transmission))
        if (scene.panes) scatter_share = select(material.pane, 1.f - straight_transmission<S, F>(bsdf, wo).probability, F(1.f));

    const Sampler<F> sampler{path.key, path.index};
    const uint32_t dimension = first_scatter_dimension + dimensions_per_scatter * uint32_t(bounce);

    // Kernels without specular lobes contain no code for caustic guiding.
    constexpr bool may_aim = S.has(Feature::specular) || S.has(Feature::transmission);
    const bool aims = may_aim && scene.focus.count > 0;
    CausticGuide<F> focus{};
    if (aims) focus = caustic_guide_at<F>(scene.focus, surface.position, ns, matte);

    // Next-event estimation, unless all lobes are delta lobes.
    const Mask<F> wants_light = scatters && !is_delta_only<F>(bsdf);
    Receiver<F> receiver{surface.position, ns};
    if constexpr (S.has(Feature::transmission))
        receiver.normal = select<F>(material.bsdf.transmission > F(0.f), splat<F>(0.f), receiver.normal);
    if constexpr (S.has(Feature::diffuse_transmission))
        receiver.normal = select<F>(material.bsdf.layers.diffuse_transmission > F(0.f), splat<F>(0.f), receiver.normal);
    if (scene.lights.count > 0 && any(wants_light)) {
        const LightPoint<F> light = sample_light_point<S, F>(scene, sampler.pair(dimension + light_dimension), receiver, wants_light);
        const Vec<F> rough_to = select<F>(light.infinite, light.position, light.position - surface.position);
        const Vec<F> from = offset_origin(surface.position, surface.error, ng, dot(rough_to, ng) > F(0.f));
        // Ends on this side of the light's plane, so that the light does not shadow itself.
        const Vec<F> end = offset_origin(light.position, light.error, light.normal, dot(rough_to, light.normal) < F(0.f));
        const Vec<F> to = select<F>(light.infinite, light.position, end - from);
        const F distance_squared = dot(to, to), distance = sqrt(distance_squared);
        const Vec<F> wi_world = to / distance;
        const Vec<F> wi = frame.to_local(wi_world);
        const IncidentLight<F> in = incident_light<S, F>(scene, light, wi_world, distance_squared);
        const BsdfValue<F> f = eval<S, F>(bsdf, wo, wi);
        Mask<F> only_sampled = light.delta, lit = Mask<F>(true);
        if constexpr (S.has(Feature::links)) {
            if (scene.links.lit_sets) {
                const Int<F> record = select(light.valid, light.light, Int<F>(0));
                lit = is_lit<F>(scene.links, record, surface.part, wants_light);
                only_sampled = only_sampled || has_own_shadows<F>(scene.links, record, wants_light);
                out.shadow_mask = shadow_mask<F>(scene.links, record);
            }
        }
        const F found_pdf = aims ? guided_pdf<F>(scene.focus, focus, wi_world, f.pdf) : f.pdf;
        const F weight = nee_mis_weight(settings.strategy, in.pdf, found_pdf, only_sampled);
        out.direct = beta * f.f_cos * in.radiance * (weight / in.pdf);
        if constexpr (S.has(Feature::transmission))
            if (scene.panes) out.direct = out.direct * (1.f / max(scatter_share, F(0x1p-24f)));
        out.light = light.light;
        out.weights.light = weight;
        out.weights.light_pdf = in.pdf;
        out.weights.light_bsdf_pdf = found_pdf;
        // Light leaks: reject directions where the shading and the geometric normal disagree.
        const Mask<F> same_side = (wi.z > F(0.f)) == (dot(wi_world, ng) > F(0.f));
        out.connects = light.valid && lit && same_side && has_light(out.direct);
        out.shadow = {from, wi_world};
        out.shadow_distance = select(light.infinite, F(infinity), distance * (1.f - 4e-7f));
    }

    // Sample the BSDF or, on diffuse surfaces, a caustic caster; then Russian roulette.
    const Pair<F> choice = sampler.pair(dimension + choice_dimension);
    const Pair<F> direction = sampler.pair(dimension + bsdf_dimension);
    F lobe = choice.x();
    if constexpr (S.has(Feature::transmission))
        if (scene.panes) lobe = lobe * scatter_share; // lobes other than the straight one keep the frequency that they have without panes
    BsdfSample<F> b = sample<S, F>(bsdf, wo, direction.x(), direction.y(), lobe);
    if constexpr (S.has(Feature::transmission))
        // rounding selected the straight lobe
        if (scene.panes) b.valid = b.valid && !(material.pane && b.delta && (b.wi.z > F(0.f)) != (wo.z > F(0.f)));
    Vec<F> wi = frame.to_world(b.wi);
    F pdf_ratio = F(1.f); // cosine pdf / mixture pdf
    if (aims && any(focus.share > F(0.f))) {
        const Mask<F> mixes = focus.share > F(0.f), aimed = mixes && choice.x() < focus.share;
        if (any(aimed)) {
            const F which = min(F(choice.x() / select(aimed, focus.share, F(1.f))), F(one_minus_epsilon));
            wi = select<F>(aimed, sample_caster_direction<F>(scene.focus, focus, which, direction.x(), direction.y()), wi);
            b.wi = select<F>(aimed, frame.to_local(wi), b.wi);
        }
        const F cosine = cosine_hemisphere_pdf(b.wi.z);
        b.valid = select(mixes, cosine > F(0.f), b.valid);
        b.pdf = select(mixes, guided_pdf<F>(scene.focus, focus, wi, cosine), b.pdf);
        pdf_ratio = select(mixes && b.valid, cosine / b.pdf, F(1.f));
        b.weight = select<F>(mixes, bsdf.diffuse * pdf_ratio, b.weight);
    }
    const Mask<F> leaves_outside = dot(wi, ng) > F(0.f);
    const Mask<F> same_side = (b.wi.z > F(0.f)) == leaves_outside;
    Vec<F> next_beta = beta * b.weight;
    out.continues = scatters && b.valid && same_side && has_light(next_beta);
    if (bounce + 1 >= settings.roulette.start && settings.roulette.rule != Roulette::Rule::off) {
        // Undo the caustic guiding pdf: oversampled paths towards casters must not be ended for their low weight.
        Vec<F> rr_throughput = beta * b.weight * (1.f / pdf_ratio);
        if constexpr (S.has(Feature::transmission)) {
            // Refraction into a solid scales beta by 1 / ior^2, which is undone on exit: undo it here too.
            const F eta_squared = params.ior * params.ior;
            rr_throughput = select<F>(solid && !leaves_outside && params.ior > F(0.f), rr_throughput * eta_squared, rr_throughput);
        }
        // Do not apply Russian roulette at delta lobes before bounce 17: such paths are likely caustic paths. A cap is needed for
        // scenes with delta lobes only.
        const Mask<F> asked = !b.delta || Mask<F>(bounce + 1 >= first_rr_bounce_at_delta);
        const F q = select(asked, survival_probability(settings.roulette, rr_throughput), F(1.f));
        out.weights.survival = q;
        out.weights.asked = out.continues && asked;
        out.continues = out.continues && !(choice.y() >= q);
        next_beta = next_beta / max(q, F(1e-30f));
    }
    out.non_finite = out.continues && !is_finite(F(next_beta.x + next_beta.y + next_beta.z));
    out.continues = out.continues && !out.non_finite;
    out.next.ray = {offset_origin(surface.position, surface.error, ng, leaves_outside), normalize(wi)};
    out.next.beta = next_beta;
    out.next.pdf = select(b.delta, F(infinity), b.pdf);
    out.next.normal = receiver.normal;
    out.next.key = path.key;
    out.next.index = path.index;
    out.next.slot = path.slot;
    if constexpr (S.has(Feature::links)) out.next.part = surface.part;
    if constexpr (S.has(Feature::dispersion)) out.next.dispersed = select(dispersed, Int<F>(1), Int<F>(0));
    if constexpr (S.has(Feature::textures)) out.next.cone = scattered_cone<F>(cone, b.delta, ns.x == ng.x && ns.y == ng.y && ns.z == ng.z);
    return out;
}

} // namespace blush::inline BLUSH_ISA
