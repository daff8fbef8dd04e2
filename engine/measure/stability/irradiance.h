// Irradiance in closed form, and its comparison with an image of a diffuse floor.
#pragma once

#include "measure/stability/rendered_image.h"
#include "measure/stability/scenes.h"

#include <array>
#include <functional>
#include <span>

namespace blush::stability {

inline constexpr Vec3d up{0, 1, 0};

// Irradiance by a polygon of radiance 1 that is completely above the horizon of a point with unit normal n (Lambert 1760): half
// the sum over edges of the subtended angle times the cosine between n and the normal of the plane through edge and point.
double polygon_irradiance(const Vec3d& point, const Vec3d& n, std::span<const Vec3d> corners);
// World corners of a rectangle light on a node with this transform.
std::array<Vec3d, 4> rectangle_corners(const Light& light, const Transform& transform);

// Irradiance (lux, equal in R, G and B) at a point of the floor y = 0.
using FloorIrradiance = std::function<double(const Vec3d& point)>;

struct FloorQuarter {
    Measured seen;
    double expected; // albedo E / pi, by the midpoint rule with eight points along each side of a pixel
};
// Adds a diffuse floor of albedo 0.6 to the scene, renders [-1, 1]^2 from 0.1 m above and compares the quarters of the image.
std::array<FloorQuarter, 4> photograph_floor(Scene scene, const FloorIrradiance& irradiance, const RenderSettings& settings);

} // namespace blush::stability
