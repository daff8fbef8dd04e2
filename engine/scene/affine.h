// Rotations, and the step between the float of records and the double in which things are placed in the world.
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

// Some unit vector at right angles to a unit vector.
Vec3d any_perpendicular(const Vec3d& a);

// Columns of the rotation; the quaternion is normalised first, a zero one is no rotation.
Affined to_affine(const Quat& rotation);
// Of a matrix with orthonormal, right-handed columns (the translation is not looked at). w >= 0.
Quat to_quat(const Affined& rotation);

} // namespace blush
