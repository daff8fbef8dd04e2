#include "measure/metrics/flip_color.h"

#include <cmath>

namespace blush::flip {
namespace {

constexpr Vec3 white{0.950428545f, 1.f, 1.088900371f};

float lab_curve(float t) {
    constexpr float delta = 6.f / 29;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.f / 29;
}

} // namespace

Vec3 xyz_from_linear(const Vec3& c) {
    return {(0.412386563f * c.x + 0.357591500f * c.y + 0.180450484f * c.z) / white.x,
            (0.212636807f * c.x + 0.715182994f * c.y + 0.072180194f * c.z) / white.y,
            (0.019330619f * c.x + 0.119197161f * c.y + 0.950372586f * c.z) / white.z};
}

Vec3 linear_from_xyz(const Vec3& xyz) {
    const Vec3 c{xyz.x * white.x, xyz.y * white.y, xyz.z * white.z};
    return {3.241003275f * c.x - 1.537398934f * c.y - 0.498615861f * c.z, -0.969224334f * c.x + 1.875930071f * c.y + 0.041554224f * c.z,
            0.055639423f * c.x - 0.204011202f * c.y + 1.057148933f * c.z};
}

Vec3 ycxcz_from_xyz(const Vec3& c) { return {116 * c.y - 16, 500 * (c.x - c.y), 200 * (c.y - c.z)}; }

Vec3 xyz_from_ycxcz(const Vec3& c) {
    const float y = (c.x + 16) / 116;
    return {y + c.y / 500, y, y - c.z / 200};
}

Vec3 hunt_lab_from_xyz(const Vec3& c) {
    const float x = lab_curve(c.x), y = lab_curve(c.y), z = lab_curve(c.z);
    const float lightness = 116 * y - 16;
    return {lightness, 0.01f * lightness * 500 * (x - y), 0.01f * lightness * 200 * (y - z)};
}

float hyab_distance(const Vec3& a, const Vec3& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

} // namespace blush::flip
