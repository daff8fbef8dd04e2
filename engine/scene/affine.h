// Vectors and affine maps in double: what places things in the world. Rays use the lane types of core/math.h;
// these functions are compiled once, for scene-building code that runs on any machine.
#pragma once

#include "core/vec.h"

namespace blush {

Vec3d operator+(const Vec3d& a, const Vec3d& b);
Vec3d operator-(const Vec3d& a, const Vec3d& b);
Vec3d operator*(const Vec3d& a, double s);
double dot(const Vec3d& a, const Vec3d& b);
Vec3d cross(const Vec3d& a, const Vec3d& b);
double length(const Vec3d& a);
// The zero vector stays zero.
Vec3d normalized(const Vec3d& a);
// Some unit vector at right angles to a unit vector.
Vec3d any_perpendicular(const Vec3d& a);

Vec3d to_double(const Vec3& a);
Vec3 to_float(const Vec3d& a);
Affined to_double(const Affine& a);
Affine to_float(const Affined& a);

// a_from_c = a_from_b * b_from_c
Affined operator*(const Affined& a_from_b, const Affined& b_from_c);
Vec3d transform_point(const Affined& m, const Vec3d& p);
Vec3d transform_vector(const Affined& m, const Vec3d& v);
double determinant(const Affined& m);
bool is_finite(const Affined& m);

// Columns of the rotation; the quaternion is normalised first, a zero one is no rotation.
Affined to_affine(const Quat& rotation);
// Of a matrix with orthonormal, right-handed columns (the translation is not looked at). w >= 0.
Quat to_quat(const Affined& rotation);

} // namespace blush
