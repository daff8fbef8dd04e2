// KHR_materials_sheen: scattering by upright fibres, with the "Charlie" distribution of normals and masking of Estevez and Kulla
// 2017, "Production Friendly Microfacet Sheen BRDF". The base is scaled by the smaller of the sheen's transmittances on the
// way in and on the way out. At grazing angles the masking fit reflects more light than smooth fibres receive; only there the sheen is
// scaled down, again by the worse of both directions. So no energy is gained, and the BSDF is reciprocal.
#pragma once

#include "shading/bilinear.h"
#include "shading/bsdf_types.h"

namespace blush {

// Directional albedo E of white sheen. Rows: the square root of (roughness - minimum) / (1 - minimum), because smooth fibres vary
// most. Columns: the fourth root of the viewer's cosine; there is a maximum at a few thousandths.
struct SheenTable {
    static constexpr int size = 32;
    static constexpr float error = 0.02f; // of an interpolated value at most, for cosines >= 0.001
    float albedo[size * size];
};

// By quadrature on first use; deterministic. Thread-safe.
const SheenTable& sheen_table();

} // namespace blush

namespace blush::inline BLUSH_ISA {

// Smoother fibres would reflect only grazing light, in a lobe narrower than the quadrature of the table resolves.
constexpr float min_sheen_roughness = 0.07f;

// Density of the fibres' normals h per solid angle, the specification's D.
template <class F> F charlie(const F& alpha, const Vec<F>& h) {
    const F sin2 = h.x * h.x + h.y * h.y;
    const F inverse = 1.f / alpha;
    return (2.f + inverse) * blush::exp(F(0.5f * inverse * blush::log(max(sin2, F(1e-30f))))) * (0.5f * inv_pi);
}

// Fit of the masking function's exponent.
template <class F> F charlie_exponent(const F& alpha, const F& x) {
    const F t = (1.f - alpha) * (1.f - alpha);
    const auto between = [&](float rough, float smooth) { return rough + (smooth - rough) * t; };
    const F a = between(21.5473f, 25.3245f), b = between(3.82987f, 3.32435f), c = between(0.19823f, 0.16801f);
    const F d = between(-1.97760f, -1.27393f), e = between(-4.32054f, -4.85967f);
    return a / (1.f + b * blush::exp(F(c * blush::log(max(x, F(1e-12f)))))) + d * x + e;
}
// Smith's Lambda for a direction at this cosine >= 0.
template <class F> F charlie_lambda(const F& alpha, const F& cos) {
    const Mask<F> steep = cos < F(0.5f);
    const F x = charlie_exponent(alpha, select(steep, cos, F(1.f - cos)));
    return blush::exp(select(steep, x, F(2.f * charlie_exponent(alpha, F(0.5f)) - x)));
}

// f |wi.z| of white sheen by the unscaled fit; cosines > 0.
template <class F> F charlie_f_cos(const F& alpha, const Vec<F>& wo, const Vec<F>& wi) {
    const Vec<F> sum = wo + wi;
    const Vec<F> h = sum / sqrt(max(length_squared(sum), F(1e-30f)));
    return charlie(alpha, h) / ((1.f + charlie_lambda(alpha, wo.z) + charlie_lambda(alpha, wi.z)) * 4.f * wo.z);
}

// E for a direction at this cosine >= 0.
template <class F> F sheen_albedo(const SheenTable& table, const F& roughness, const F& cos) {
    constexpr float last = float(SheenTable::size - 1);
    const F row = sqrt(clamp01(F((roughness - min_sheen_roughness) * (1.f / (1.f - min_sheen_roughness))))) * last;
    const F column = sqrt(sqrt(clamp01(cos))) * last;
    return bilinear(table.albedo, SheenTable::size, row, column);
}

template <class F> F charlie_albedo(const Sheen<F>& sheen, const F& cos) { return sheen_albedo(sheen_table(), sheen.roughness, cos); }

// Sets everything except the probability; wo in the viewer's frame.
template <class F> Sheen<F> make_sheen(const LayerParams<F>& m, const Vec<F>& wo) {
    const F roughness = max(m.sheen_roughness, F(min_sheen_roughness));
    Sheen<F> sheen{m.sheen_color, max_component(m.sheen_color), roughness, roughness * roughness, F(0.f), F(0.f)};
    if (any(sheen.strength > F(0.f))) sheen.albedo = charlie_albedo(sheen, wo.z);
    return sheen;
}

// Transmittance of the sheen for both directions; exactly 1 without sheen. wi.z < 0 is transmitted light.
template <class F> F left_below_sheen(const Sheen<F>& sheen, const Vec<F>& wi) {
    if (!any(sheen.strength > F(0.f))) return F(1.f);
    const F taken = min(max(sheen.albedo, charlie_albedo(sheen, F(abs(wi.z)))), F(1.f));
    return 1.f - sheen.strength * taken;
}
// The same for light from the viewer's direction.
template <class F> F left_below_sheen(const Sheen<F>& sheen) { return 1.f - sheen.strength * min(sheen.albedo, F(1.f)); }

// Value and pdf of the sheen alone, without its sampling probability: uniform over the hemisphere, because its lobes fill it.
template <class F> BsdfValue<F> eval_sheen(const Sheen<F>& sheen, const Vec<F>& wo, const Vec<F>& wi) {
    const Mask<F> above = sheen.strength > F(0.f) && wi.z > F(0.f);
    if (!any(above)) return {splat<F>(0.f), F(0.f)};
    const F gain = max(max(sheen.albedo, charlie_albedo(sheen, F(abs(wi.z)))), F(1.f));
    const F f_cos = select(above, charlie_f_cos(sheen.alpha, wo, wi) / gain, F(0.f));
    return {sheen.color * f_cos, select(above, F(0.5f * inv_pi), F(0.f))};
}

} // namespace blush::inline BLUSH_ISA
