// A chain of specular events (mirrors and smooth glass) with its derivatives by the direction it begins with: ray differentials (Igehy
// 1999, "Tracing Ray Differentials"), through interpolated normals.
#pragma once

#include "render/integrator/hit_stages.h"
#include "shading/bsdf.h"

namespace blush::inline BLUSH_ISA {

// A ray that depends on two parameters.
template <class F> struct DifferentialRay {
    Vec<F> position, direction;
    Vec<F> position_u, position_v, direction_u, direction_v;
};

// How a triangle's interpolated normal turns as its point moves.
template <class F> struct NormalGradient {
    Vec<F> edge1, edge2;     // world
    Vec<F> change1, change2; // of the interpolated normal along the edges, not normalised
    Vec<F> normal;           // interpolated, not normalised
    Mask<F> smooth;          // false: it does not turn

    // Derivative of the unit normal by a parameter that moves the point by `moved` in the triangle's plane.
    Vec<F> along(const Vec<F>& moved) const {
        const Vec<F> g = cross(edge1, edge2);
        const F scale = 1.f / max(dot(g, g), F(1e-37f));
        const F u = dot(cross(moved, edge2), g) * scale, v = dot(cross(edge1, moved), g) * scale;
        const Vec<F> change = change1 * u + change2 * v;
        const F l2 = max(dot(normal, normal), F(1e-30f));
        const Vec<F> turned = (change - normal * (dot(normal, change) / l2)) / sqrt(l2);
        return select<F>(smooth, turned, splat<F>(0.f));
    }
};
template <Features S, class F>
NormalGradient<F> normal_gradient(const SceneTables& scene, const Hit<F>& hit, const Int<F>& part, const Mask<F>& active) {
    const HitTriangle<F> triangle = hit_triangle<F>(scene, hit, part, active);
    const auto& [i0, i1, i2] = triangle.vertices;
    const TriangleVertices<F> p = gather_vertices<F>(scene.positions, i0, i1, i2);
    NormalGradient<F> g;
    g.edge1 = p.p1 - p.p0;
    g.edge2 = p.p2 - p.p0;
    g.smooth = active && as_mask((triangle.flags & int32_t(part_smooth)) != 0);
    g.normal = g.change1 = g.change2 = splat<F>(0.f);
    if (any(g.smooth)) {
        const TriangleVertices<F> n = gather_vertices<F>(scene.normals, i0, i1, i2);
        g.normal = triangle.interpolate([&](const Int<F>& i) { return gather3<F>(scene.normals, i); });
        g.change1 = n.p1 - n.p0;
        g.change2 = n.p2 - n.p0;
    }
    if constexpr (S.has(Feature::instances)) {
        const Int<F> transform = gather_field(scene.parts, &PartRecord::transform, part);
        const Mask<F> instanced = active && as_mask(transform >= 0);
        if (any(instanced)) {
            const Int<F> row = select(instanced, transform, Int<F>(0)) * int32_t(sizeof(InstanceRecord) / 4);
            const float* first = &scene.instances->world_from_object.x.x;
            const auto through = [&](int c, const Vec<F>& v) {
                const auto column = [&](int k) {
                    return Vec<F>{gather(first + k, row), gather(first + k + 1, row), gather(first + k + 2, row)};
                };
                return select<F>(instanced, column(c) * v.x + column(c + 3) * v.y + column(c + 6) * v.z, v);
            };
            g.edge1 = through(0, g.edge1);
            g.edge2 = through(0, g.edge2);
            g.normal = through(12, g.normal);
            g.change1 = through(12, g.change1);
            g.change2 = through(12, g.change2);
        }
    }
    return g;
}

// What a specular event does to the ray.
template <class F> struct SpecularEvent {
    Mask<F> valid;
    Mask<F> refracts;
    Mask<F> disperses; // the ray carries a single wavelength behind it
    Vec<F> transmittance;
    Int<F> part;
};
// The event at the hit of ray.direction; advances `ray` to behind it. `refracts`: which event; the lanes of `chooses` take it by chance
// with the random number `u`. `wavelength`: the ray's, a step of the visible spectrum. In the lanes of `active`, whose hit is a surface.
template <Features S, class F>
[[gnu::noinline, gnu::flatten]] SpecularEvent<F> specular_event(const SceneTables& scene, const EstimatorSettings& settings,
                                                                const Hit<F>& hit, Mask<F> refracts, const Mask<F>& chooses, const F& u,
                                                                const Int<F>& wavelength, const Mask<F>& active, DifferentialRay<F>& ray) {
    const Surface<F> surface = surface_at<S, F>(scene, hit, active);
    MaterialPoint<F> material = material_at<S, F>(scene.materials, surface.material, surface.texture, surface.color, active);
    const Int<F> flags = gather_field(scene.materials.materials, &MaterialRecord::flags, surface.material);
    const HitSide<F> side = hit_side<S, F>(surface, material, ray.direction);
    const Vec<F> absorbed = attenuate<S, F>(splat<F>(1.f), material, hit.t, side, active);
    const ShadingFrame<F> shading = shading_frame_at<S, F>(surface, material, side.wo, side.front, side.solid);
    SpecularEvent<F> event;
    event.disperses = Mask<F>(false);
    if constexpr (S.has(Feature::dispersion)) {
        event.disperses = active && side.solid && material.dispersion > F(0.f);
        const F ior = dispersed_ior(material.bsdf.ior, material.dispersion, wavelength_at<F>(wavelength).nanometres);
        material.bsdf.ior = select(event.disperses, ior, material.bsdf.ior);
    }
    const Bsdf<F> bsdf = make_bsdf<S, F>(material.bsdf, shading.wo, settings.energy);
    event.part = surface.part;
    const FacetAlbedo<F> albedo = facet_albedo<S>(bsdf, bsdf.cos);
    refracts = select(chooses, u >= facet_probability<S>(albedo, Mask<F>(true)), refracts);
    event.refracts = refracts;
    event.transmittance = absorbed * select<F>(refracts, albedo.transmitted * bsdf.radiance_scale, albedo.reflected);
    const Mask<F> delta = bsdf.smooth || (refracts && bsdf.straight);
    event.valid = active && as_mask((flags & int32_t(material_chains)) != 0) && delta && (!refracts || bsdf.solid) &&
                  !reflects_partly_within<S, F>(side, bsdf, refracts) && max_component(event.transmittance) > F(0.f);

    // The normal on the ray's side, and its derivatives.
    const Mask<F> below = shading.wo.z < F(0.f);
    const Vec<F> n = select<F>(below, -shading.ns, shading.ns);
    const NormalGradient<F> gradient = normal_gradient<S, F>(scene, hit, surface.part, active && !shading.behind);
    const F sign = select(dot(n, surface.ns) < F(0.f), F(-1.f), F(1.f));
    const F c = bsdf.cos, g = refracted_g(bsdf.interface, c), c_minus_g = -bsdf.interface.eta_squared_minus_1 / (c + g);
    const F facing = dot(ray.direction, surface.ng);
    const auto move = [&](const Vec<F>& position, const Vec<F>& direction) {
        const Vec<F> moved = position + direction * hit.t;
        return moved - ray.direction * (dot(moved, surface.ng) / facing);
    };
    const Vec<F> d = ray.direction;
    const auto turn = [&](const Vec<F>& direction, const Vec<F>& moved) {
        const Vec<F> dn = gradient.along(moved) * sign;
        const F dc = -(dot(direction, n) + dot(d, dn));
        const F dg = c * dc / max(g, F(1e-6f));
        const Vec<F> mirrored = direction + (n * dc + dn * c) * 2.f;
        const Vec<F> refracted = (direction + dn * c_minus_g + n * (dc - dg)) / bsdf.interface.eta;
        return select<F>(refracts, refracted, mirrored);
    };
    ray.position_u = move(ray.position_u, ray.direction_u);
    ray.position_v = move(ray.position_v, ray.direction_v);
    ray.direction_u = turn(ray.direction_u, ray.position_u);
    ray.direction_v = turn(ray.direction_v, ray.position_v);
    ray.direction = normalize(select<F>(refracts, (d + n * c_minus_g) / bsdf.interface.eta, d + n * (2.f * c)));
    const Mask<F> outward = dot(ray.direction, shading.ng) > F(0.f);
    // Light leaks: the shading and the geometric normal must agree about the side.
    const Mask<F> same_side = (dot(ray.direction, shading.ns) > F(0.f)) == outward;
    event.valid = event.valid && same_side && is_finite(ray.direction);
    ray.position = offset_origin(surface.position, surface.error, shading.ng, outward);
    return event;
}

} // namespace blush::inline BLUSH_ISA
