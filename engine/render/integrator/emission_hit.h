// Emission at ray hits: environment, suns, spheres and emissive triangles,
// each with its MIS weight against next event estimation (Veach 1997).
#pragma once

#include "render/integrator/estimator_settings.h"
#include "render/integrator/light_path_weights.h"
#include "render/integrator/light_sampling.h"
#include "render/integrator/links.h"
#include "render/integrator/manifold/path_chain.h"
#include "render/integrator/mis_weights.h"
#include "render/integrator/path.h"

namespace blush::inline BLUSH_ISA {

// The MIS weight of emission at `position` beside light paths (light_path_weights.h), which do not find that of manifold sampling.
template <Features S, class F> F beside_light_paths(const SceneTables& scene, const F& weight, const Path<F>& path, const Int<F>& light,
                                                    const Vec<F>& position, const Vec<F>& normal, const Mask<F>& active) {
    if constexpr (S.has(Feature::light_paths)) {
        const F beside = weight_beside(weight, light_path_ratio<S, F>(scene, path, light, position, normal, active));
        return select(found_by_manifolds<S, F>(scene, path, light, active), weight, beside);
    }
    return weight;
}
// MIS weight of emission hit by the path's ray, considering light linking of the surface that the ray left.
template <Features S, class F>
F if_linked(const SceneTables& scene, const F& weight, const Int<F>& light, const Path<F>& path, const Mask<F>& active) {
    if constexpr (S.has(Feature::links))
        if (scene.links.lit_sets) return linked_weight<F>(scene.links, weight, light, path.part, path.pdf, active);
    return weight;
}

// Calls visit(light, radiance times MIS weight, MIS weight, lanes) for each light at infinity in the direction of the path's ray;
// light is a record of the light table, -1 for an environment that is only a backdrop.
template <Features S, class F, class Visit> void for_each_background_light(const SceneTables& scene, const EstimatorSettings& settings,
                                                                           const Path<F>& path, int bounce, const Mask<F>& active,
                                                                           const Visit& visit) {
    const LightTables& lights = scene.lights;
    // NEE pdf for the MIS weight. Under Strategy::bsdf there is no NEE, and its tables do not exist.
    const bool aims = settings.mis.strategy != Strategy::bsdf;
    const Receiver<F> from{path.ray.origin, path.normal};
    if constexpr (S.has(Feature::environment)) {
        if (bounce > 0 ? scene.environment.lights_scene : scene.environment.visible_to_camera) {
            const Vec<F> radiance = environment_radiance<F>(scene.environment, path.ray.direction, active);
            F weight = F(1.f);
            if (aims) {
                const F pdf = environment_nee_pdf<S, F>(scene, from, path.ray.direction, active);
                weight = emission_mis_weight<F>(settings.mis, path.pdf, pdf);
                weight = beside_light_paths<S, F>(scene, weight, path, Int<F>(lights.environment), path.ray.origin, path.normal, active);
            }
            visit(lights.environment, radiance * weight, weight, active);
        }
    }
    if constexpr (S.has(Feature::suns)) {
        for (int i = 0; i < lights.sun_count; ++i) {
            const LightRecord& sun = lights.lights[lights.suns[i]];
            if (bounce == 0 && sun.flags & light_hidden) continue;
            const Mask<F> inside = active && in_sun_disk<F>(path.ray.direction, splat<F>(sun.position), F(sun.cone_height));
            if (!any(inside)) continue;
            F weight = F(1.f);
            if (aims) {
                const F pdf = cone_pdf(F(sun.cone_height)) * nee_probability<S, F>(scene, from, Int<F>(lights.suns[i]), inside);
                weight = emission_mis_weight<F>(settings.mis, path.pdf, pdf);
                weight = beside_light_paths<S, F>(scene, weight, path, Int<F>(lights.suns[i]), path.ray.origin, path.normal, inside);
                weight = select(found_by_manifolds<S, F>(scene, path, Int<F>(lights.suns[i]), inside), F(0.f), weight);
            }
            weight = if_linked<S, F>(scene, weight, Int<F>(lights.suns[i]), path, inside);
            visit(lights.suns[i], splat<F>(sun.emission) * weight, weight, inside);
        }
    }
}

// Sum over all lights at infinity, and the environment's MIS weight.
template <class F> struct BackgroundLight {
    Vec<F> radiance;
    F weight;
};
template <Features S, class F> BackgroundLight<F> background_light(const SceneTables& scene, const EstimatorSettings& settings,
                                                                   const Path<F>& path, int bounce, const Mask<F>& active) {
    BackgroundLight<F> all{splat<F>(0.f), F(1.f)};
    for_each_background_light<S, F>(scene, settings, path, bounce, active,
                                    [&](int32_t light, const Vec<F>& radiance, const F& weight, const Mask<F>& lanes) {
                                        all.radiance = select<F>(lanes, all.radiance + radiance, all.radiance);
                                        if (light == scene.lights.environment) all.weight = weight;
                                    });
    return all;
}

// Light record of a part's triangle; -1: none.
template <class F> Int<F> light_of_triangle(const SceneTables& scene, const Int<F>& part, const Int<F>& triangle) {
    const Int<F> first = gather_field(scene.parts, &PartRecord::first_light, part);
    return select(as_mask(first >= 0), Int<F>(first + triangle), Int<F>(-1));
}

// Factor of the light's IES profile in the unit direction `away`; 1 without a profile. `light` is -1 or valid.
template <class F> F emission_profile(const SceneTables& scene, const Int<F>& light, const Vec<F>& away, const Mask<F>& active) {
    if (!scene.lights.profiles.records) return F(1.f);
    const Int<F> profile = gather_field(scene.lights.lights, &LightRecord::profile, max(light, Int<F>(0)));
    const Mask<F> shaped = active && as_mask(light >= 0) && as_mask(profile >= 0);
    if (!any(shaped)) return F(1.f);
    return select(shaped, profile_factor<F>(scene.lights.profiles, select(shaped, profile, Int<F>(0)), away, shaped), F(1.f));
}

// MIS weight of a triangle's emission, hit at distance t with cosine `facing`.
template <Features S, class F> F surface_emission_mis_weight(const SceneTables& scene, const MisSettings& mis, const Path<F>& path,
                                                             const Int<F>& found, const F& t, const F& facing, const Mask<F>& active) {
    if (mis.strategy == Strategy::bsdf) return F(1.f);
    // Where only the ray can find the emission, the weight is 1 whatever the pdf of NEE, which costs much.
    const Mask<F> sampled = active && as_mask(found >= 0) && !(path.pdf == F(infinity));
    const Int<F> light = select(sampled, found, Int<F>(0));
    const Receiver<F> from{path.ray.origin, path.normal};
    const F per_area =
        nee_probability<S, F>(scene, from, light, sampled) * gather_field(scene.lights.lights, &LightRecord::inverse_area, light);
    const F pdf = select(sampled, area_to_solid_angle(per_area, F(t * t), facing), F(0.f));
    return emission_mis_weight<F>(mis, path.pdf, pdf);
}

// Radiance of an emissive triangle hit by the path's ray, and its MIS
// weight. `emission`: of the material; facing: cosine between ray and plane.
template <class F> struct EmissionHit {
    Vec<F> radiance;
    F weight;
};
// Where it is: position and geometric normal are only read beside light paths.
template <class F> struct EmissionPlace {
    Int<F> part;
    Vec<F> position, normal;
};
template <Features S, class F> EmissionHit<F> emission_hit(const SceneTables& scene, const MisSettings& mis, const Path<F>& path,
                                                           const EmissionPlace<F>& at, const Hit<F>& hit, const F& facing,
                                                           const Vec<F>& emission, const Mask<F>& emitting) {
    const Int<F> light = light_of_triangle<F>(scene, at.part, select(emitting, hit.triangle, Int<F>(0)));
    const F alone = surface_emission_mis_weight<S, F>(scene, mis, path, light, hit.t, facing, emitting);
    const F unlinked = beside_light_paths<S, F>(scene, alone, path, light, at.position, at.normal, emitting);
    EmissionHit<F> found{emission, if_linked<S, F>(scene, unlinked, light, path, emitting)};
    if constexpr (S.has(Feature::light_profiles))
        found.radiance = found.radiance * emission_profile<F>(scene, light, -path.ray.direction, emitting);
    return found;
}

// Radiance of a sphere light hit by the path's ray, times its MIS weight, and that weight. Black from inside.
template <class F> struct SphereEmissionHit {
    Vec<F> radiance;
    F weight;
    Int<F> object;
};
template <Features S, class F> SphereEmissionHit<F> sphere_emission_hit(const SceneTables& scene, const MisSettings& mis,
                                                                        const Path<F>& path, const Int<F>& sphere, const F& t,
                                                                        const Mask<F>& active) {
    const LightRecord* lights = scene.lights.lights;
    const Int<F> light = select(active, Int<F>(sphere + scene.lights.first_sphere), Int<F>(0));
    const Vec<F> to_center = gather_field3<F>(lights, &LightRecord::position, light) - path.ray.origin;
    const F height = sphere_cone_height(dot(to_center, to_center), gather_field(lights, &LightRecord::radius, light));
    const Mask<F> outside = active && height > F(0.f);
    F found = F(1.f);
    if (mis.strategy != Strategy::bsdf) { // Strategy::bsdf has no NEE and no table
        const Receiver<F> from{path.ray.origin, path.normal};
        const F pdf = cone_pdf(select(outside, height, F(1.f))) * nee_probability<S, F>(scene, from, light, outside);
        found = emission_mis_weight<F>(mis, path.pdf, pdf);
    }
    const Vec<F> position = path.ray.origin + path.ray.direction * t, normal = normalize(position - (path.ray.origin + to_center));
    found = beside_light_paths<S, F>(scene, found, path, light, position, normal, outside);
    const F weight = if_linked<S, F>(scene, found, light, path, active);
    Vec<F> emission = gather_field3<F>(lights, &LightRecord::emission, light);
    if constexpr (S.has(Feature::light_profiles)) emission = emission * emission_profile<F>(scene, light, -path.ray.direction, outside);
    return {select<F>(outside, emission * weight, splat<F>(0.f)), weight, gather_field(lights, &LightRecord::object, light)};
}

} // namespace blush::inline BLUSH_ISA
