// False colours: maps steps of luminance to colours.
#pragma once

#include "core/vec.h"

#include <array>
#include <cstdint>

namespace blush {

constexpr int false_color_bands = 13; // between the two ends; one more below and one above

struct FalseColorScale {
    enum class Of : uint8_t { off, scene, exposed } of = Of::off; // luminance as rendered, or after white balance and exposure
    float low = 0, high = 1;                                      // log2 of the luminance at both ends
    bool operator==(const FalseColorScale&) const = default;
};

// sRGB-encoded: black below, 13 bands, white above. Dark to bright in hues with distinct names: purple, violet, blues, cyan,
// greens, grey in the middle, yellow, amber, orange, red, pink.
extern const std::array<Vec3, false_color_bands + 2> false_colors;

// 0 below the scale, 1 .. 13 for its bands, 14 above. NaN counts as below.
int false_color_band(float luminance, const FalseColorScale& scale);
// log2 of the luminance where band `band` begins, 1 .. 14.
float false_color_edge(int band, const FalseColorScale& scale);

} // namespace blush
