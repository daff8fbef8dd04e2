// The transfer function of sRGB (IEC 61966-2-1).
#pragma once

#include <cmath>

namespace blush {

inline float srgb_from_linear(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f; }
inline float linear_from_srgb(float x) { return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f); }

} // namespace blush
