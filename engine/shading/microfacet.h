// The GGX distribution of microfacet normals with Smith's separable masking, as in glTF 2.0 Appendix B (Walter et al. 2007,
// "Microfacet Models for Refraction through Rough Surfaces"). Local frame, z is the normal. All formulas use x, y, z of the
// direction instead of 1 - z^2, and avoid division by a cosine: precise for alpha down to 1e-4 and grazing directions.
#pragma once

#include "core/math.h"

namespace blush::inline BLUSH_ISA {

// Below this perceptual roughness a surface is treated as perfectly smooth: its lobe is narrower than single precision resolves.
constexpr float smooth_roughness = 0.01f;

// Anisotropic alpha along the local x and y (KHR_materials_anisotropy; Heitz 2014, "Understanding
// the Masking-Shadowing Function in Microfacet-Based BRDFs", stretched GGX). Functions below
// accept it in place of one alpha and give bit-identical results if both are equal.
template <class F> struct Stretch {
    F x, y;
    F x_over_y, y_over_x;
    F product;
};
template <class F> Stretch<F> make_stretch(const F& x, const F& y) { return {x, y, x / y, y / x, x * y}; }

template <class F> F alpha_along_x(const F& alpha) { return alpha; }
template <class F> F alpha_along_y(const F& alpha) { return alpha; }
template <class F> F alpha_along_x(const Stretch<F>& alpha) { return alpha.x; }
template <class F> F alpha_along_y(const Stretch<F>& alpha) { return alpha.y; }

// Density of microfacet normals h (unit) per projected solid angle.
template <class F> F ggx(const F& alpha, const Vec<F>& h) {
    const F alpha2 = alpha * alpha;
    const F k = h.x * h.x + h.y * h.y + alpha2 * (h.z * h.z);
    return alpha2 / (pi * k * k);
}
template <class F> F ggx(const Stretch<F>& alpha, const Vec<F>& h) {
    const F k = h.x * h.x * alpha.y_over_x + h.y * h.y * alpha.x_over_y + alpha.product * (h.z * h.z);
    return alpha.product / (pi * k * k);
}

// Unmasked share of the microfacets seen from w, divided by |w.z|.
template <class F> F masking_over_cos(const F& alpha, const Vec<F>& w) {
    const F tilt = w.x * w.x + w.y * w.y;
    return 2.f / (abs(w.z) + sqrt(w.z * w.z + alpha * alpha * tilt));
}
template <class F> F masking_over_cos(const Stretch<F>& alpha, const Vec<F>& w) {
    const F tilt = w.x * w.x * alpha.x_over_y + w.y * w.y * alpha.y_over_x;
    return 2.f / (abs(w.z) + sqrt(w.z * w.z + alpha.product * tilt));
}
template <class Alpha, class F> F masking(const Alpha& alpha, const Vec<F>& w) { return abs(w.z) * masking_over_cos(alpha, w); }

// Samples a microfacet normal visible from wo, wo.z >= 0, with density masking(wo) ggx(h)
// max(0, dot(wo, h)) / wo.z: Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with
// Spherical Caps", with the cap's coordinates rearranged so that h.z > 0 is a product.
template <class Alpha, class F> Vec<F> sample_visible_normal(const Alpha& alpha, const Vec<F>& wo, const F& u, const F& v) {
    const F along_x = alpha_along_x(alpha), along_y = alpha_along_y(alpha);
    const Vec<F> o = normalize(Vec<F>{wo.x * along_x, wo.y * along_y, wo.z});
    const F up = 1.f + o.z;
    const F down = (o.x * o.x + o.y * o.y) / up; // 1 - o.z
    const F rise = (1.f - v) * up;               // from the cap's rim: the sampled point's z is rise - o.z
    const F sin_theta = sqrt(up * v * (rise + down));
    const SinCos<F> a = sincos_turns(u);
    return normalize(Vec<F>{along_x * (sin_theta * a.cos + o.x), along_y * (sin_theta * a.sin + o.y), rise});
}

} // namespace blush::inline BLUSH_ISA
