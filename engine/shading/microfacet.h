// The GGX distribution of facet normals with Smith's separable masking, as glTF 2.0 Appendix B has them (Walter et al. 2007,
// "Microfacet Models for Refraction through Rough Surfaces"). Local frame, z is the normal. Every formula is in x, y, z of the
// direction instead of 1 - z^2, and without a division by a cosine: alpha down to 1e-4 and grazing directions keep their digits.
#pragma once

#include "core/math.h"

namespace blush::inline BLUSH_ISA {

// Below this perceptual roughness a surface counts as perfectly smooth: its lobe is narrower than what single precision resolves.
constexpr float smooth_roughness = 0.01f;

// Density of facet normals h (unit) per projected solid angle.
template <class F> F ggx(const F& alpha, const Vec<F>& h) {
    const F alpha2 = alpha * alpha;
    const F k = h.x * h.x + h.y * h.y + alpha2 * (h.z * h.z);
    return alpha2 / (pi * k * k);
}

// Share of the facets seen from w that are not masked, over |w.z|.
template <class F> F masking_over_cos(const F& alpha, const Vec<F>& w) {
    const F tilt = w.x * w.x + w.y * w.y;
    return 2.f / (abs(w.z) + sqrt(w.z * w.z + alpha * alpha * tilt));
}
template <class F> F masking(const F& alpha, const Vec<F>& w) { return abs(w.z) * masking_over_cos(alpha, w); }

// A facet normal as seen from wo, wo.z >= 0, with density masking(wo) ggx(h) max(0, dot(wo, h)) / wo.z: Dupuy and Benyoub 2023,
// "Sampling Visible GGX Normals with Spherical Caps", the cap's coordinates rearranged so that h.z > 0 is a product.
template <class F> Vec<F> sample_visible_normal(const F& alpha, const Vec<F>& wo, const F& u, const F& v) {
    const Vec<F> o = normalize(Vec<F>{wo.x * alpha, wo.y * alpha, wo.z});
    const F up = 1.f + o.z;
    const F down = (o.x * o.x + o.y * o.y) / up; // 1 - o.z
    const F rise = (1.f - v) * up;               // from the cap's rim: the sampled point's z is rise - o.z
    const F sin_theta = sqrt(up * v * (rise + down));
    const SinCos<F> a = sincos_turns(u);
    return normalize(Vec<F>{alpha * (sin_theta * a.cos + o.x), alpha * (sin_theta * a.sin + o.y), rise});
}

} // namespace blush::inline BLUSH_ISA
