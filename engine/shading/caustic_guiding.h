// Caustic guiding. Mirrors and glass cast caustics on diffuse surfaces. NEE cannot connect through them: a path finds a caustic
// only if it leaves the diffuse surface towards the right point of a specular object. So diffuse surfaces sample more directions
// into the cones that bound specular objects (bounding spheres). Directions are sampled from the mixture of both densities
// (one-sample model, Veach 1997, section 9.2.4): the expectation does not depend on the spheres, and path weights grow at most by
// 1 / (1 - max_guided_share).
#pragma once

#include "core/sampling.h"
#include "core/vec.h"
#include "shading/sphere_light.h"

#include <cstdint>

namespace blush {

struct CasterSphere {
    Vec3 center;  // relative to the tables' origin
    float radius; // metres
};

struct CausticCasterTables {
    const CasterSphere* spheres = nullptr;
    int32_t count = 0;
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

// Oversampling factor of directions into a sphere. The optimal factor is the square root of the ratio of variances (Neyman 1934).
// Two spheres that fill an eighth of a ceiling's view and cause nine tenths of its variance give about this factor. The second
// constant is the maximal share of guided paths.
constexpr float guiding_boost = 6, max_guided_share = 0.5f;

// sin^2 of the angular radius below which a sphere is not sampled.
constexpr float min_caster_sin2 = 1e-6f;

// The caster spheres as seen from a surface point.
template <class F> struct CausticGuide {
    Vec<F> from, normal;
    F total; // sum of the spheres' weights
    F share; // share of guided samples
};

template <class F> struct CasterCone {
    Vec<F> to; // from the point to the sphere's centre
    F height;  // 1 - cos of its angular radius
    F weight;  // 0: not sampled
};
template <class F> CasterCone<F> caster_cone(const CasterSphere& sphere, const Vec<F>& from, const Vec<F>& normal) {
    CasterCone<F> c;
    c.to = splat<F>(sphere.center) - from;
    const F d2 = dot(c.to, c.to);
    c.height = sphere_cone_height(d2, F(sphere.radius));
    // Approximate share of the cosine-weighted hemisphere; spheres with a centre below the horizon are not guided.
    const F part = 2.f * c.height * max(F(0.f), dot(c.to, normal)) / sqrt(max(d2, F(1e-30f)));
    c.weight = select(F(sphere.radius) * sphere.radius >= min_caster_sin2 * d2, part * (guiding_boost - 1.f), F(0.f));
    return c;
}

// `lambertian`: lanes whose surface is Lambertian; others are not guided.
template <class F>
CausticGuide<F> caustic_guide_at(const CausticCasterTables& table, const Vec<F>& from, const Vec<F>& normal, const Mask<F>& lambertian) {
    CausticGuide<F> f{from, normal, F(0.f), F(0.f)};
    for (int i = 0; i < table.count; ++i) f.total = f.total + caster_cone<F>(table.spheres[i], from, normal).weight;
    f.share = select(lambertian, min(f.total / (1.f + f.total), F(max_guided_share)), F(0.f));
    return f;
}

// Mixture pdf of a unit direction, where the BSDF alone has `pdf`.
template <class F> F caster_pdf(const CausticCasterTables& table, const CausticGuide<F>& f, const Vec<F>& direction, const F& pdf) {
    F sum = F(0.f);
    for (int i = 0; i < table.count; ++i) {
        const CasterSphere& sphere = table.spheres[i];
        const CasterCone<F> c = caster_cone<F>(sphere, f.from, f.normal);
        // Compares the distance of the ray from the centre: 1 - cos would lose all digits for a small cone.
        const Mask<F> ahead = c.weight > F(0.f) && dot(direction, c.to) > F(0.f);
        const Mask<F> within = ahead && length_squared(cross(direction, c.to)) <= F(sphere.radius * sphere.radius);
        sum = sum + select(within, c.weight / c.height, F(0.f));
    }
    return (1.f - f.share) * pdf + f.share * (0.5f * inv_pi) * sum / max(f.total, F(1e-30f));
}

// Samples a direction into one of the spheres' cones, for lanes with
// share > 0; u, v and `choice`, which selects the sphere, in [0, 1).
template <class F>
Vec<F> sample_caster_direction(const CausticCasterTables& table, const CausticGuide<F>& f, const F& choice, const F& u, const F& v) {
    Vec<F> to{F(0.f), F(0.f), F(1.f)};
    F height = F(1.f), left = choice * f.total;
    Mask<F> open = Mask<F>(true);
    for (int i = 0; i < table.count; ++i) {
        const CasterCone<F> c = caster_cone<F>(table.spheres[i], f.from, f.normal);
        const Mask<F> it = open && c.weight > F(0.f);
        to = select<F>(it, c.to, to);
        height = select(it, c.height, height);
        open = open && !(it && left < c.weight);
        left = left - c.weight;
    }
    return basis_around(Vec<F>(to / length(to))).to_world(sample_cone(height, u, v));
}

} // namespace blush::inline BLUSH_ISA
