// The transfer function of sRGB (IEC 61966-2-1).
#pragma once

#include <cmath>

namespace blush {

inline float srgb_from_linear(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f; }
template <class T> T linear_from_srgb(T x) { return x <= T(0.04045) ? x / T(12.92) : std::pow((x + T(0.055)) / T(1.055), T(2.4)); }

} // namespace blush
