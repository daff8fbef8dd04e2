// Sampling warps from the unit square with their densities, and the power heuristic.
#pragma once

#include "core/math.h"

namespace blush::inline BLUSH_ISA {

// MIS weight of a sample of density `pdf`, which another strategy samples with density `other`: power heuristic with exponent 2
// (Veach and Guibas 1995). Computed from the ratio, so that huge densities do not overflow; pdf > 0.
template <class F> F power_heuristic(const F& pdf, const F& other) {
    const F r = other / pdf;
    return 1.f / (1.f + r * r);
}

// Point on the unit disk, density 1 / pi in area.
template <class F> Vec2T<F> sample_disk(const F& u, const F& v) {
    const F r = sqrt(u);
    const SinCos<F> a = sincos_turns(v);
    return {r * a.cos, r * a.sin};
}

// Direction in the upper hemisphere with density cos / pi.
template <class F> Vec<F> sample_cosine_hemisphere(const F& u, const F& v) {
    const Vec2T<F> d = sample_disk(u, v);
    return {d.x, d.y, sqrt(max(F(0.f), 1.f - u))};
}
template <class F> F cosine_hemisphere_pdf(const F& cos_theta) { return max(cos_theta, F(0.f)) * inv_pi; }

// Uniform direction in the cone around +z of solid angle 2 pi `height`, height = 1 - cos(half angle). Takes the height, since 1 -
// cos cancels for small angles such as the sun's. Density 1 / (2 pi height).
template <class F> Vec<F> sample_cone(const F& height, const F& u, const F& v) {
    const F h = u * height; // 1 - cos
    const F sin_theta = sqrt(max(F(0.f), h * (2.f - h)));
    const SinCos<F> a = sincos_turns(v);
    return {sin_theta * a.cos, sin_theta * a.sin, 1.f - h};
}

// Barycentric coordinates (vertices 1 and 2) of a uniform point on a triangle: Heitz 2019, "A Low-Distortion Map Between Triangle
// and Square".
template <class F> Vec2T<F> sample_triangle(const F& u, const F& v) {
    const Mask<F> upper = v > u;
    const F b1 = select(upper, u * 0.5f, u - v * 0.5f);
    const F b2 = select(upper, v - u * 0.5f, v * 0.5f);
    return {b1, b2};
}

} // namespace blush::inline BLUSH_ISA
