// Encodes radiance for the network: the perceptually uniform curve of Open Image Denoise, templated over the lane type.
#pragma once

#include "core/lanes.h"
#include "core/math.h"

namespace blush::denoise {

// The largest radiance that the network supports, after exposure.
inline constexpr float max_network_radiance = 65504.f;

// Natural logarithm of a normal number > 0: ln m + e ln 2 with m in [sqrt 1/2, sqrt 2], ln m = 2 artanh((m - 1) / (m + 1)) as a
// series; error below 2e-7 of max(1, |ln x|).
template <class F> F log(const F& x) {
    const Int<F> e = (float_bits(x) - 0x3f3504f3) >> 23;
    const F m = float_from_bits(float_bits(x) - (e << 23));
    const F s = (m - 1.f) / (m + 1.f), s2 = s * s;
    return to_float(e) * 0.693147181f + 2.f * s * (1.f + s2 * (0.333333333f + s2 * (0.2f + s2 * (0.142857143f + s2 * 0.111111111f))));
}

// T(y) of radiance y >= 0, piecewise: linear, power, logarithm.
template <class F> F encode_radiance(const F& y) {
    const F logarithm = 0.192653254f * denoise::log(y + 0.00626026094f) + 0.998620152f;
    const Mask<F> dark = y <= F(0.0322087631f);
    if (!any(dark)) return logarithm;
    const F linear = 1412.83765f * y;
    const F power = 1.64593172f * blush::exp(0.431384981f * denoise::log(max(y, F(1e-7f)))) - 0.00294139609f;
    return select(y <= F(1.5794576e-6f), linear, select(dark, power, logarithm));
}

// The inverse of the above, x >= 0.
template <class F> F decode_radiance(const F& x) {
    const F exponential = blush::exp((x - 0.998620152f) * (1.f / 0.192653254f)) - 0.00626026094f;
    const Mask<F> dark = x <= F(0.370974749f);
    if (!any(dark)) return exponential;
    const F linear = x * (1.f / 1412.83765f);
    const F power = blush::exp(denoise::log((x + 0.00294139609f) * (1.f / 1.64593172f)) * (1.f / 0.431384981f));
    return select(x <= F(0.00223151711f), linear, select(dark, power, exponential));
}

} // namespace blush::denoise
