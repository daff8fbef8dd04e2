// Quaternions for cameras, handles and angle fields. Unit quaternions, right-handed, components x, y, z, w as in glTF.
#pragma once

#include "scene/affine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush {

inline Quat multiply(const Quat& a, const Quat& b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

inline Quat normalized(const Quat& q) {
    const float n = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return n > 0 ? Quat{q.x / n, q.y / n, q.z / n, q.w / n} : Quat{};
}

inline Vec3d rotate(const Quat& q, const Vec3d& v) {
    const Vec3d u{q.x, q.y, q.z};
    const Vec3d t = cross(u, v) * 2.0;
    return v + t * double(q.w) + cross(u, t);
}

// Right-handed rotation about a unit axis.
inline Quat axis_angle(const Vec3d& axis, double radians) {
    const double s = std::sin(radians / 2);
    return {float(axis.x * s), float(axis.y * s), float(axis.z * s), float(std::cos(radians / 2))};
}

// The rotation that maps -Z to `forward` (any length but 0), with +Y as close to `up` as possible.
inline Quat looking_along(const Vec3d& forward, const Vec3d& up = {0, 1, 0}) {
    const Vec3d z = normalize(-forward);
    Vec3d x = cross(up, z);
    if (length(x) < 1e-6) x = cross(std::abs(z.y) > 0.9 ? Vec3d{0, 0, z.y > 0 ? -1.0 : 1.0} : Vec3d{0, 1, 0}, z);
    x = normalize(x);
    return to_quat(Affined{x, cross(z, x), z, {0, 0, 0}});
}

// Euler angles in degrees: rotations about X, then Y, then Z (fixed axes) whose product is `q`.
inline Vec3d euler_degrees(const Quat& q) {
    const Vec3d x = rotate(q, {1, 0, 0}), y = rotate(q, {0, 1, 0}), z = rotate(q, {0, 0, 1});
    const double to_degrees = 180 / std::numbers::pi;
    const double pitch = std::asin(std::clamp(-x.z, -1.0, 1.0));
    if (std::abs(x.z) > 0.9999995) return {std::atan2(-z.y, y.y) * to_degrees, pitch * to_degrees, 0};
    return {std::atan2(y.z, z.z) * to_degrees, pitch * to_degrees, std::atan2(x.y, x.x) * to_degrees};
}

inline Quat from_euler_degrees(const Vec3d& degrees) {
    const double to_radians = std::numbers::pi / 180;
    const Quat x = axis_angle({1, 0, 0}, degrees.x * to_radians), y = axis_angle({0, 1, 0}, degrees.y * to_radians),
               z = axis_angle({0, 0, 1}, degrees.z * to_radians);
    return normalized(multiply(z, multiply(y, x)));
}

} // namespace blush
