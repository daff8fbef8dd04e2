// Rotations, and conversion between the float of scene records and the double of world transforms.
// The arithmetic itself is core/math.h's, at T = double.
#pragma once

#include "core/math.h"
#include "core/vec.h"

namespace blush {

Vec3d to_double(const Vec3& a);
Vec3 to_float(const Vec3d& a);
Affined to_double(const Affine& a);
Affine to_float(const Affined& a);
bool is_finite(const Affined& m);

// Returns a unit vector perpendicular to the unit vector `a`; its rotation about `a` is arbitrary.
Vec3d any_perpendicular(const Vec3d& a);

// Rotation matrix of the quaternion, which is normalised first; a zero quaternion gives the identity.
Affined to_affine(const Quat& rotation);
// Quaternion with w >= 0 of a matrix with orthonormal, right-handed columns. Ignores the translation.
Quat to_quat(const Affined& rotation);

} // namespace blush
