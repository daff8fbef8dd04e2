// Plain vector data over a lane type F: float, double, or a SIMD register of lanes.
// Data only; arithmetic is in math.h.
#pragma once

#include <cstdint>

namespace blush {

template <class F> struct Vec2T {
    F x, y;
    bool operator==(const Vec2T&) const = default;
};

template <class F> struct Vec {
    F x, y, z;
    bool operator==(const Vec&) const = default;
};

template <class F> struct Vec4T {
    F x, y, z, w;
    bool operator==(const Vec4T&) const = default;
};

using Vec2 = Vec2T<float>;
using Vec3 = Vec<float>;
using Vec4 = Vec4T<float>;
using Vec3d = Vec<double>;

// Unit quaternion x, y, z, w as in glTF; {0, 0, 0, 1} is the identity.
struct Quat {
    float x = 0, y = 0, z = 0, w = 1;
    bool operator==(const Quat&) const = default;
};

// Affine map p -> x * p.x + y * p.y + z * p.z + t: three columns and a translation.
// Variables are named after the two spaces, `world_from_light`, so that adjacent names of a product match.
template <class T> struct AffineT {
    Vec<T> x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, t{0, 0, 0};
    bool operator==(const AffineT&) const = default;
};

using Affine = AffineT<float>;
using Affined = AffineT<double>;

} // namespace blush
