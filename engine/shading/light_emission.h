// Emission of light paths: the density with which a point of a light and a direction are sampled. A pair of a light and a caster of
// caustics is chosen by the flux that the caster gets from the light; then a point of the light, uniform in area, and a direction to the
// bounding sphere of the caster, uniform in solid angle. Light at infinity has a direction first, then a point of the disk that the sphere
// shows to it. One pair of each light is with the whole scene instead of a caster, so that no path of light paths is missed: directions
// then have the density of the cosine.
#pragma once

#include "shading/caustic_guiding.h"
#include "shading/environment.h"
#include "shading/light.h"

#include <cstdint>

namespace blush {

struct EmissionTables {
    const float* chances =
        nullptr; // by light record: probabilities of the pairs with each caster, then with the scene; null: no light paths
    const uint32_t* thresholds = nullptr; // that sample the pairs (core/distribution.h)
    int32_t lights = 0;                   // with records there; others emit no light paths
    CausticCasterTables casters;
    CasterSphere scene{}; // contains all surfaces
    float paths = 0;      // light paths for one camera sample of every pixel
    bool alone = false;   // of lights without size, and by a delta lobe of the first surface: no other strategy finds this light

    bool empty() const { return !chances; }
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

// A point of a light as its paths leave it.
template <class F> struct EmissionPoint {
    Int<F> light;      // record
    Mask<F> infinite;  // a sun or the environment,
    Mask<F> point;     // a point without size,
    Mask<F> two_sided; // a triangle that emits on both sides
    Vec<F> position;   // infinite: any point of the ray
    Vec<F> normal;     // unit; infinite, point: not read
    Vec<F> away;       // unit direction of the ray, away from the light
    F density;         // of the position, 1/m^2; infinite: of the direction, 1/sr; point, parallel sun: 1
};

// Cosine between the light's normal and the ray; 1 for a point and at infinity.
template <class F> F emission_cosine(const EmissionPoint<F>& p) {
    return select(p.infinite || p.point, F(1.f), abs(dot(p.normal, p.away)));
}

// Density of position and direction with which light paths are emitted, over the cosine at the light: per area and projected solid angle;
// at infinity per solid angle and area of the beam. `active`: lanes with a valid light.
template <class F>
[[gnu::noinline, gnu::flatten]] F emission_density(const EmissionTables& tables, const EmissionPoint<F>& p, const Mask<F>& active) {
    const int32_t casters = tables.casters.count;
    const Int<F> first = select(active, p.light, Int<F>(0)) * (casters + 1);
    const F cosine = max(emission_cosine(p), F(1e-6f));
    const Mask<F> emits = p.infinite || p.point || p.two_sided || dot(p.normal, p.away) > F(0.f);
    // Over all directions: the density of the cosine.
    const F even = select(p.point, F(0.25f * inv_pi), select(p.two_sided, F(0.5f * inv_pi), F(inv_pi)));
    F sum = F(0.f);
    for (int32_t k = 0; k <= casters; ++k) {
        const CasterSphere& sphere = k < casters ? tables.casters.spheres[k] : tables.scene;
        const F chance = gather(tables.chances + k, first);
        const Vec<F> to = splat<F>(sphere.center) - p.position;
        const F d2 = dot(to, to), r2 = F(sphere.radius * sphere.radius);
        const Mask<F> in_beam = length_squared(cross(p.away, to)) <= r2;
        const F beam = select(in_beam, F(inv_pi) / r2, F(0.f));
        const F height = sphere_cone_height(d2, F(sphere.radius)); // 0 inside the sphere
        const Mask<F> outside = height > F(0.f) && Mask<F>(k < casters);
        const F cone = select(in_beam && dot(p.away, to) > F(0.f), cone_pdf(select(outside, height, F(1.f))) / cosine, F(0.f));
        sum = sum + chance * select(p.infinite, beam, select(outside, cone, even));
    }
    return select(active && emits, sum * p.density, F(0.f));
}

} // namespace blush::inline BLUSH_ISA
