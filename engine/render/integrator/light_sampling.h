// Next event estimation (NEE): selects a light, a point on it, and computes the incident light.
#pragma once

#include "core/sampler.h"
#include "render/integrator/surface.h"
#include "shading/clearcoat.h"
#include "shading/light.h"
#include "shading/sphere_light.h"

namespace blush::inline BLUSH_ISA {

// A sampled point on a light.
template <class F> struct LightPoint {
    Mask<F> valid, infinite, delta;
    Vec<F> position; // end of the shadow ray; infinite: unit direction towards the light
    Vec<F> error;    // bound on the position's rounding error
    Vec<F> normal;   // triangle, sphere: unit
    Vec<F> emission; // nits; delta: candela or lux
    F probability;   // selection probability of this light
    F density;       // pdf. infinite, sphere: per solid angle; triangle: per area; delta: 1
    Int<F> kind, light;
    Mask<F> two_sided;
    F clearcoat; // triangle: share of the surface under a clear coat; only with Feature::clearcoat
};

// Light arriving at a receiver along the unit direction wi: radiance (delta: irradiance on a surface facing wi) and its pdf.
template <class F> struct IncidentLight {
    Vec<F> radiance;
    F pdf;
};

// A point of an emissive triangle with its material inputs.
template <class F> struct LightSurface {
    Int<F> material;
    TexturePoint<F> at;
    F vertex_alpha; // 1 without vertex colours
};
// The point at edge1 * along.x + edge2 * along.y.
template <Features S, class F>
LightSurface<F> light_surface(const SceneTables& scene, const Int<F>& light, const Vec2T<F>& along, const Mask<F>& active) {
    const LightRecord* lights = scene.lights.lights;
    const Mask<F> swapped = as_mask((gather_field(lights, &LightRecord::flags, light) & int32_t(light_mirrored)) != 0);
    const Vec2T<F> b{select(swapped, along.y, along.x), select(swapped, along.x, along.y)};
    const Int<F> triangle = gather_field(lights, &LightRecord::triangle, light);
    const Int<F> part = select(active, gather_field(lights, &LightRecord::part, light), Int<F>(0));
    const Int<F> flags = gather_field(scene.parts, &PartRecord::flags, part);
    const Int<F> first_vertex = gather_field(scene.parts, &PartRecord::first_vertex, part);
    const Int<F> at = gather_field(scene.parts, &PartRecord::first_index, part) + select(active, triangle, Int<F>(0)) * 3;
    const auto vertex = [&](int k) { return Int<F>(first_vertex + to_signed(gather(scene.indices + k, at))); };
    const std::array<F, 3> weights{1.f - b.x - b.y, b.x, b.y};
    F vertex_alpha = F(1.f);
    if constexpr (S.has(Feature::vertex_colors)) {
        const Mask<F> colored = active && as_mask((flags & int32_t(part_colors)) != 0);
        if (any(colored)) {
            F mixed = F(0.f);
            for (int k = 0; k < 3; ++k)
                mixed = mixed + gather(scene.colors + 3, select(colored, Int<F>(vertex(k) * 4), Int<F>(0))) * weights[size_t(k)];
            vertex_alpha = select(colored, mixed, F(1.f));
        }
    }
    return {gather_field(scene.parts, &PartRecord::material, part),
            texture_point<F>(scene, flags, {vertex(0), vertex(1), vertex(2)}, weights, active), vertex_alpha};
}

// Mean radiance of an emissive triangle with textured emission or alpha, at the point edge1 * along.x + edge2 * along.y:
// multiplied by the opacity, because with stochastic opacity rays hit it with that probability.
template <Features S, class F>
Vec<F> varying_emission(const SceneTables& scene, const Int<F>& light, const Vec2T<F>& along, const Mask<F>& active) {
    const LightSurface<F> surface = light_surface<S, F>(scene, light, along, active);
    return emission_at<S, F>(scene.materials, surface.material, surface.at, active) *
           opacity_at<S, F>(scene.materials, surface.material, surface.at, surface.vertex_alpha, active);
}

// The stages of sample_light_point fill `p` where its light is of their kind; p.position and p.emission are those of the light's
// record. (u, v): random numbers in [0, 1).
template <class F> Mask<F> has_kind(const LightPoint<F>& p, LightKind kind) { return p.valid && as_mask(p.kind == int32_t(kind)); }

// Uniform over the area of an emissive triangle.
template <Features S, class F> [[gnu::always_inline]] inline void sample_triangle_light(const SceneTables& scene, const Int<F>& flags,
                                                                                        const F& u, const F& v, LightPoint<F>& p) {
    if constexpr (S.has(Feature::emissive_triangles)) {
        const LightRecord* lights = scene.lights.lights;
        const Mask<F> triangle = has_kind(p, LightKind::triangle);
        if (!any(triangle)) return;
        const Vec<F> e1 = gather_field3<F>(lights, &LightRecord::edge1, p.light);
        const Vec<F> e2 = gather_field3<F>(lights, &LightRecord::edge2, p.light);
        const Vec2T<F> b = sample_triangle(u, v);
        const Vec<F> on = p.position + e1 * b.x + e2 * b.y;
        const Vec<F> error = splat<F>(1.f) * (max_component(abs(p.position) + abs(e1) + abs(e2)) * gamma_bound(8));
        p.error = select<F>(triangle, error, p.error);
        p.normal = select<F>(triangle, normalize(cross(e1, e2)), p.normal);
        p.density = select(triangle, gather_field(lights, &LightRecord::inverse_area, p.light), p.density);
        if constexpr (S.has(Feature::textures) || S.has(Feature::vertex_colors)) {
            const Mask<F> varying = triangle && as_mask((flags & int32_t(light_varying)) != 0);
            if (any(varying)) p.emission = select<F>(varying, varying_emission<S, F>(scene, p.light, b, varying), p.emission);
        }
        if constexpr (S.has(Feature::clearcoat)) {
            const LightSurface<F> surface = light_surface<S, F>(scene, p.light, b, triangle);
            p.clearcoat = select(triangle, clearcoat_at<S, F>(scene.materials, surface.material, surface.at, triangle), p.clearcoat);
        }
        p.position = select<F>(triangle, on, p.position);
    }
}

// Uniform over the solid angle of a sphere light as seen from `from` (sphere_light.h).
template <Features S, class F> [[gnu::always_inline]] inline void sample_sphere_light(const SceneTables& scene, const Vec<F>& from,
                                                                                      const F& u, const F& v, LightPoint<F>& p) {
    if constexpr (S.has(Feature::sphere_lights)) {
        const Mask<F> sphere = has_kind(p, LightKind::sphere);
        if (!any(sphere)) return;
        const F radius = gather_field(scene.lights.lights, &LightRecord::radius, p.light);
        const SpherePoint<F> s = sample_sphere(p.position, radius, from, u, v);
        // Embree's error bound of a ray's hit point on the sphere.
        const F error = (max_component(abs(p.position)) + max_component(abs(from)) + s.distance) * gamma_bound(16);
        p.error = select<F>(sphere, splat<F>(1.f) * error, p.error);
        p.normal = select<F>(sphere, s.normal, p.normal);
        p.density = select(sphere, cone_pdf(s.height), p.density);
        p.position = select<F>(sphere, s.position, p.position);
        p.valid = p.valid && !(sphere && s.height <= F(0.f));
    }
}

// Uniform over the disk of a sun; a sun without a disk is a delta light.
template <Features S, class F>
[[gnu::always_inline]] inline void sample_sun(const SceneTables& scene, const F& u, const F& v, LightPoint<F>& p) {
    if constexpr (S.has(Feature::suns)) {
        const Mask<F> sun = has_kind(p, LightKind::sun);
        if (!any(sun)) return;
        const F height = gather_field(scene.lights.lights, &LightRecord::cone_height, p.light);
        const Mask<F> disk = sun && height > F(0.f);
        const Basis<F> around = basis_around(p.position);
        const Vec<F> towards = around.to_world(sample_cone(height, u, v));
        p.position = select<F>(disk, normalize(towards), p.position);
        p.density = select(disk, cone_pdf(height), p.density);
        p.infinite = p.infinite || sun;
        p.delta = p.delta || (sun && !disk);
    }
}

// A direction of the environment map in the lanes of `by_map`; `v`: random bits.
template <Features S, class F> [[gnu::always_inline]] inline void
sample_environment_light(const SceneTables& scene, const F& u, const UInt<F>& v, const Mask<F>& by_map, LightPoint<F>& p) {
    if constexpr (S.has(Feature::environment)) {
        const Mask<F> environment = by_map && has_kind(p, LightKind::environment);
        if (!any(environment)) return;
        const EnvironmentSample<F> e = sample_environment<F>(scene.environment, u, v);
        p.position = select<F>(environment, e.direction, p.position);
        p.emission = select<F>(environment, e.radiance, p.emission);
        p.density = select(environment, e.pdf, p.density);
        p.infinite = p.infinite || environment;
    }
}

// Probability that NEE selects `light`, other than the environment, for that receiver.
template <Features S, class F>
F nee_probability(const SceneTables& scene, const Receiver<F>& to, const Int<F>& light, const Mask<F>& active) {
    const F p = light_probability<S, F>(scene.lights, to, light, active);
    if constexpr (S.has(Feature::environment))
        if (scene.lights.portals.rows) return p * (1.f - portal_at<F>(scene.lights.portals, to.position).share);
    return p;
}

// Pdf of NEE for a direction of the environment, 1/sr: of its importance map and of the receiver's portal together.
template <Features S, class F>
F environment_nee_pdf(const SceneTables& scene, const Receiver<F>& to, const Vec<F>& direction, const Mask<F>& active) {
    const LightTables& lights = scene.lights;
    F pdf = F(0.f);
    if (lights.samples_environment)
        pdf = environment_pdf<F>(scene.environment, direction) * light_probability<S, F>(lights, to, Int<F>(lights.environment), active);
    if (!lights.portals.rows) return pdf;
    const Portal<F> portal = portal_at<F>(lights.portals, to.position);
    return pdf * (1.f - portal.share) + portal.share * portal_pdf<F>(lights.portals, portal, direction);
}

// Which lanes sample their portal instead of a light; `rest`: the random numbers behind that decision.
template <class F> struct PortalSelection {
    Mask<F> chosen = Mask<F>(false);
    Portal<F> portal{Int<F>(0), F(0.f)};
    Pair<F> rest;
};
template <class F>
PortalSelection<F> choose_portal(const PortalTables& portals, const Vec<F>& position, const Pair<F>& random, const Mask<F>& active) {
    PortalSelection<F> selection{.rest = random};
    selection.portal = portal_at<F>(portals, position);
    selection.chosen = active && selection.portal.share > F(0.f);
    if (portals.alone) return selection;
    // The first bit decides, the others remain.
    selection.rest.bits_x = select(selection.chosen, UInt<F>((random.bits_x << 1) | (pcg_hash(random.bits_y) & 1u)), random.bits_x);
    selection.chosen = selection.chosen && as_mask((random.bits_x >> 31) != 0u);
    return selection;
}

// Fills the lanes that sample their portal, and gives all directions of the environment the pdf of both strategies
// (environment_nee_pdf).
template <Features S, class F> [[gnu::noinline]] void sample_environment_portal(const SceneTables& scene,
                                                                                const PortalSelection<F>& selection, const F& v,
                                                                                const Receiver<F>& to, LightPoint<F>& p) {
    const LightTables& lights = scene.lights;
    const F share = selection.portal.share;
    const Mask<F> environment = has_kind(p, LightKind::environment);
    p.probability = select(environment, F(1.f), p.probability * (1.f - share));
    if (!any(environment)) return;
    p.infinite = p.infinite || environment;
    p.position = select<F>(selection.chosen, sample_portal<F>(lights.portals, selection.portal, selection.rest.bits_x, v), p.position);
    const EnvironmentCell<F> cell = environment_cell<F>(scene.environment, p.position);
    p.emission = select<F>(selection.chosen, radiance_of_cell<F>(scene.environment, cell, selection.chosen), p.emission);
    F pdf = share * portal_pdf<F>(lights.portals, selection.portal, p.position);
    if (lights.samples_environment)
        pdf = pdf + (1.f - share) * pdf_of_cell<F>(scene.environment, cell) *
                        light_probability<S, F>(lights, to, Int<F>(lights.environment), environment);
    p.density = select(environment, pdf, p.density);
}

// A light as its record has it, for the stages of sampling.
template <class F> [[gnu::always_inline]] inline LightPoint<F> begin_light_point(const LightRecord* lights, const Int<F>& flags,
                                                                                 const DiscreteSample<F>& pick, const Mask<F>& active) {
    LightPoint<F> p;
    p.light = pick.index;
    p.probability = pick.probability;
    p.valid = active && pick.probability > F(0.f);
    p.kind = gather_field(lights, &LightRecord::kind, pick.index);
    p.two_sided = as_mask((flags & int32_t(light_two_sided)) != 0);
    p.position = gather_field3<F>(lights, &LightRecord::position, pick.index);
    p.emission = gather_field3<F>(lights, &LightRecord::emission, pick.index);
    p.error = splat<F>(0.f);
    p.normal = splat<F>(0.f);
    p.density = F(1.f);
    p.infinite = Mask<F>(false);
    p.delta = Mask<F>(false);
    p.clearcoat = F(0.f);
    return p;
}

// Samples a light for a receiver, and a point on it.
template <Features S, class F>
LightPoint<F> sample_light_point(const SceneTables& scene, const Pair<F>& random, const Receiver<F>& to, const Mask<F>& active) {
    const LightRecord* lights = scene.lights.lights;
    PortalSelection<F> by_portal{.rest = random};
    if constexpr (S.has(Feature::environment))
        if (scene.lights.portals.rows) by_portal = choose_portal<F>(scene.lights.portals, to.position, random, active);
    DiscreteSample<F> pick{Int<F>(0), F(0.f), F(0.f)};
    if (scene.lights.count > 0) pick = pick_light<S, F>(scene.lights, to, by_portal.rest, active && !by_portal.chosen);
    if constexpr (S.has(Feature::environment)) {
        pick.index = select(by_portal.chosen, Int<F>(scene.lights.environment), pick.index);
        pick.probability = select(by_portal.chosen, F(1.f), pick.probability);
    }
    const F u = pick.remainder, v = random.y();

    const Int<F> flags = gather_field(lights, &LightRecord::flags, pick.index);
    LightPoint<F> p = begin_light_point<F>(lights, flags, pick, active);
    sample_triangle_light<S, F>(scene, flags, u, v, p);
    if constexpr (S.has(Feature::point_lights)) p.delta = p.delta || has_kind(p, LightKind::point);
    sample_sphere_light<S, F>(scene, to.position, u, v, p);
    sample_sun<S, F>(scene, u, v, p);
    sample_environment_light<S, F>(scene, u, random.bits_y, !by_portal.chosen, p);
    if constexpr (S.has(Feature::environment))
        if (scene.lights.portals.rows) sample_environment_portal<S, F>(scene, by_portal, v, to, p);
    return p;
}

// Radiance and pdf at a receiver at squared distance `distance_squared`,
// in direction wi from it; lights at infinity ignore the distance.
template <Features S, class F>
IncidentLight<F> incident_light(const SceneTables& scene, const LightPoint<F>& p, const Vec<F>& wi, const F& distance_squared) {
    IncidentLight<F> in{p.emission, p.probability * p.density};
    if constexpr (S.has(Feature::emissive_triangles)) {
        const Mask<F> triangle = as_mask(p.kind == int32_t(LightKind::triangle));
        const F cos_light = -dot(p.normal, wi);
        const F facing = select(p.two_sided, abs(cos_light), cos_light);
        const Mask<F> seen = facing > F(0.f);
        in.radiance = select<F>(triangle && !seen, splat<F>(0.f), in.radiance);
        if constexpr (S.has(Feature::clearcoat)) in.radiance = in.radiance * through_clearcoat(p.clearcoat, facing);
        in.pdf = select(triangle, area_to_solid_angle(in.pdf, distance_squared, select(seen, facing, F(1.f))), in.pdf);
    }
    if constexpr (S.has(Feature::point_lights)) {
        const Mask<F> point = p.delta && !p.infinite;
        in.radiance = select<F>(point, in.radiance * (1.f / distance_squared), in.radiance);
    }
    if constexpr (S.has(Feature::light_profiles)) {
        if (!scene.lights.profiles.records) return in;
        const Int<F> profile = gather_field(scene.lights.lights, &LightRecord::profile, p.light);
        const Mask<F> shaped = p.valid && as_mask(profile >= 0);
        if (any(shaped)) {
            const F factor = profile_factor<F>(scene.lights.profiles, select(shaped, profile, Int<F>(0)), -wi, shaped);
            in.radiance = select<F>(shaped, in.radiance * factor, in.radiance);
        }
    }
    return in;
}

// The length of a shadow ray from `o` along the unit vector `d`; at most `distance`. `outward`: it leads to the front of the light. A
// triangle on the convex hull of its mesh is not hidden by this mesh: in the clearance box, nothing blocks the ray, so it ends where it
// enters the box (lamp_clearance.h).
template <class F> F distance_before_lamp(const LightTables& lights, const Int<F>& light, const Vec<F>& o, const Vec<F>& d,
                                          const F& distance, const Mask<F>& outward) {
    const Int<F> clearance = gather_field(lights.lights, &LightRecord::clearance, light);
    const Mask<F> on_hull = outward && as_mask(clearance >= 0);
    if (!any(on_hull)) return distance;
    const Int<F> box = select(on_hull, clearance, Int<F>(0));
    const Vec<F> low = gather_field3<F>(lights.clearances, &ClearanceBox::low, box);
    const Vec<F> high = gather_field3<F>(lights.clearances, &ClearanceBox::high, box);
    const auto enter = [](const F& from, const F& along, const F& a, const F& b) { return (select(along > F(0.f), a, b) - from) / along; };
    const F entry = max(enter(o.x, d.x, low.x, high.x), max(enter(o.y, d.y, low.y, high.y), enter(o.z, d.z, low.z, high.z)));
    // A receiver in the box has no entry. Rounding must not end the ray before the box.
    return select(on_hull && entry > F(0.f), min(F(entry * (1.f + 0x1p-20f)), distance), distance);
}

} // namespace blush::inline BLUSH_ISA
