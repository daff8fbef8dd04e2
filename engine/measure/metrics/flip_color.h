// The colour spaces of FLIP. White is D65; linear colours are Rec.709.
#pragma once

#include "core/vec.h"

namespace blush::flip {

// CIE XYZ relative to white: white is (1, 1, 1).
Vec3 xyz_from_linear(const Vec3& rgb);
Vec3 linear_from_xyz(const Vec3& xyz);

// YCxCz: linearised CIELAB, in which filtering is valid.
Vec3 ycxcz_from_xyz(const Vec3& xyz);
Vec3 xyz_from_ycxcz(const Vec3& ycxcz);

// CIELAB with a and b scaled by lightness, since dark colours look less colourful (Hunt 1952).
Vec3 hunt_lab_from_xyz(const Vec3& xyz);

// HyAB distance: city-block in lightness plus Euclidean in chroma (Abasi, Amani Tehran and Fairchild 2020).
float hyab_distance(const Vec3& lab_a, const Vec3& lab_b);

} // namespace blush::flip
