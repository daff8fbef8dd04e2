// How different two colours look: the CIE 1976 UCS chromaticity diagram, CIELAB, and the CIEDE2000 colour difference.
#pragma once

#include "core/vec.h"

#include <string_view>

namespace blush {

// CIE 1976 uniform chromaticity scale: u' = 4 X / (X + 15 Y + 3 Z), v' = 9 Y / (X + 15 Y + 3 Z) (CIE 15:2004, 8.2.1), of linear
// Rec.709. Black has the chromaticity of white.
struct UcsPoint {
    double u = 0, v = 0;
};
UcsPoint ucs_of(const Vec3d& rgb);

// CIELAB (CIE 15:2004, 8.2.1) of linear Rec.709 against a white of this luminance at D65.
struct Lab {
    double l = 0, a = 0, b = 0;
};
Lab lab_of(const Vec3d& rgb, double white);

// CIEDE2000 with k_L = k_C = k_H = 1: Sharma, Wu and Dalal, "The CIEDE2000 Color-Difference Formula: Implementation Notes, Supplementary
// Test Data, and Mathematical Observations", Color Research and Application 30(1), 2005. About 1 is just noticeable side by side.
double delta_e_2000(const Lab& x, const Lab& y);

// CIEDE2000 between two colours of linear Rec.709, both exposed to the luminance of L* = 50: what they differ by other than brightness. 0
// if one is black.
double hue_difference(const Vec3d& x, const Vec3d& y);
// The luminance of a white against which this luminance has L* = 50.
double white_for_grey(double luminance);

// The colour towards which a step in the chromaticity diagram leads: that of the hues below whose direction from D65 is nearest. "red",
// "orange", "yellow", "green", "cyan", "blue", "violet" or "magenta".
std::string_view hue_towards(double du, double dv);

} // namespace blush
