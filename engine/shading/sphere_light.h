// Sphere lights, sampled by solid angle (Shirley, Wang and Zimmerman 1996; Pharr, Jakob, Humphreys, "Physically Based Rendering",
// 6.2.4): no samples on the far side, and equal weights even next to the sphere.
#pragma once

#include "core/sampling.h"

namespace blush::inline BLUSH_ISA {

// Height, 1 - cos, of the cone that a sphere at distance^2 subtends; 0 from inside, where its outside is invisible.
template <class F> F sphere_cone_height(const F& distance_squared, const F& radius) {
    const F sin2 = radius * radius / distance_squared;
    // 1 - sqrt(1 - sin2) would lose all digits for a small or distant sphere.
    return select(sin2 < F(1.f), sin2 / (1.f + sqrt(max(F(0.f), 1.f - sin2))), F(0.f));
}

template <class F> struct SpherePoint {
    Vec<F> position, normal; // on the side visible from `from`; unit
    F height;                // of the cone: the pdf is cone_pdf(height); 0: invisible
    F distance;              // from `from` to the centre
};
// Samples a point of the sphere, uniformly over the directions subtended at `from`.
template <class F> SpherePoint<F> sample_sphere(const Vec<F>& center, const F& radius, const Vec<F>& from, const F& u, const F& v) {
    const Vec<F> to = center - from;
    const F d2 = dot(to, to), d = sqrt(d2);
    const F height = sphere_cone_height(d2, radius);
    const F sin_max = radius / d;
    const F h = u * height; // 1 - cos theta, theta between the direction and that of the centre
    const F sin2 = h * (2.f - h);
    const F q = sqrt(max(F(0.f), 1.f - sin2 / (sin_max * sin_max)));
    // The angle alpha at the centre, by the law of sines in the triangle of `from`, the centre and the nearer intersection.
    const F cos_alpha = sin2 / sin_max + (1.f - h) * q;
    const F sin_alpha = ((1.f - h) / sin_max - q) * sqrt(sin2);
    const SinCos<F> a = sincos_turns(v);
    const Basis<F> frame = basis_around(Vec<F>(to / d));
    const Vec<F> normal = frame.to_world(Vec<F>{sin_alpha * a.cos, sin_alpha * a.sin, -cos_alpha});
    return {center + normal * radius, normal, height, d};
}

} // namespace blush::inline BLUSH_ISA
