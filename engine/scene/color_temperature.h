// The colour of a glowing black body, for lights that are set in kelvin.
#pragma once

#include "core/vec.h"

namespace blush {

constexpr float min_kelvin = 1000, max_kelvin = 40000;

// Linear Rec.709 RGB of a black body at `kelvin` (clamped to 1000 .. 40000), scaled to luminance 1, so that turning the temperature does
// not dim the light: Planck's law, summed over the visible range against the CIE 1931 observer. Components outside Rec.709 are clamped to 0
// before scaling; below about 1900 K blue is.
//
// `green_tint` is the distance from the Planckian locus in CIE 1960 uv, at right angles to it (Duv of ANSI C78.377): above 0 towards green,
// below towards magenta; -0.05 .. 0.05 is what can still be called white.
Vec3 black_body_color(float kelvin, float green_tint = 0);

// The temperature of the black body whose colour is nearest in CIE 1960 uv (correlated colour temperature, CIE 15:2004), and the distance from
// it as black_body_color takes it. Temperatures beyond 1000 .. 40000 K end there. `rgb` is linear Rec.709; the answer is that of D65 where it is
// no colour.
struct ColorTemperature {
    float kelvin = 6504, green_tint = 0.0032f;
};
ColorTemperature temperature_of(const Vec3& rgb);

} // namespace blush
