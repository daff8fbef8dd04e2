// The product of the transmittances along a ray. Embree reports hits in an order that depends on the other rays of the packet, and
// the rounding of a product depends on the order of its factors. So logarithms are added, as integers. Only +, -, * and / are used,
// so that all machines agree.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace blush {

constexpr double depth_units = 0x1p24; // of a factor of 1/2; the error of a product of n factors is at most n * 2e-8

// Transmittances of this depth, and less, are 0 in single precision. The next sum does not overflow.
constexpr uint32_t opaque_depth = 150u << 24;

// Russian roulette: a product p below 1/16 becomes 1/16 with the probability 16 p, else 0. So few rays have to be followed through
// dozens of surfaces. The decision does not depend on the order of the surfaces: it is known before.
constexpr uint32_t roulette_depth = 4u << 24;

// -log2(transmittance), for a transmittance in [2^-24, 1]: exponent, and series of atanh around 1.
inline uint32_t optical_depth(float transmittance) {
    const auto bits = std::bit_cast<int32_t>(transmittance);
    const int32_t k = (bits - 0x3f3504f3) >> 23; // so that the mantissa is in [sqrt(1/2), sqrt(2))
    const double m = double(std::bit_cast<float>(bits - k * (1 << 23)));
    const double s = (m - 1) / (m + 1), s2 = s * s;
    double series = 0;
    for (int n = 13; n > 0; n -= 2) series = series * s2 + 1.0 / n;
    const double log2 = k + 2 * s * series * std::numbers::log2e;
    return uint32_t(0.5 - log2 * depth_units);
}

// Its inverse for sums of depths: Taylor series of e^x.
inline float transmittance_of(uint32_t depth) {
    if (depth == 0) return 1;
    const uint32_t halvings = depth >> 24;
    const double x = (halvings - double(depth) / depth_units) * std::numbers::ln2; // in (-ln 2, 0]
    double series = 1;
    for (int n = 12; n > 0; --n) series = 1 + series * x / n;
    return float(std::ldexp(series, -int(halvings)));
}

// Depth of 1/16 times a random number in (0, 1]: the product survives up to there.
inline uint32_t roulette_limit(float random) { return roulette_depth + optical_depth(random); }

} // namespace blush
