// The colour of a black body, for lights with a colour temperature in kelvin.
#pragma once

#include "core/vec.h"

namespace blush {

constexpr float min_kelvin = 1000, max_kelvin = 40000;

// Linear Rec.709 RGB of a black body at `kelvin` (clamped to 1000 .. 40000), scaled to luminance 1, so that changing the
// temperature does not dim the light: Planck's law, summed over the visible range against the CIE 1931 observer. Components
// outside Rec.709 (blue, below about 1900 K) are clamped to 0 before scaling.
//
// `green_tint` is the distance from the Planckian locus in CIE 1960 uv, perpendicular to it (Duv of ANSI C78.377): positive
// towards green, negative towards magenta. White light lies within -0.05 .. 0.05.
Vec3 black_body_color(float kelvin, float green_tint = 0);

// Correlated colour temperature (CIE 15:2004): that of the black body whose colour is nearest in CIE 1960 uv, and the distance
// from it as black_body_color takes it. Clamped to 1000 .. 40000 K. `rgb` is linear Rec.709; black and invalid colours give D65.
struct ColorTemperature {
    float kelvin = 6504, green_tint = 0.0032f;
};
ColorTemperature temperature_of(const Vec3& rgb);

} // namespace blush
