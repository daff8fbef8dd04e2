// Irradiance in closed form, and the test that a picture of a matte floor shows it.
#pragma once

#include "picture.h"
#include "scenes.h"

#include <functional>
#include <span>

namespace blush::test {

// Of a polygon of radiance 1 wholly above the horizon of a point with unit normal n: Lambert 1760, half the sum over edges of
// the angle each subtends times the cosine between n and the normal of the plane through it and the point.
double polygon_irradiance(const Vec3d& point, const Vec3d& n, std::span<const Vec3d> corners);

// Irradiance (lux, RGB alike) of a point of the floor y = 0.
using FloorIrradiance = std::function<double(const Vec3d& point)>;

// Puts a matte floor of albedo 0.6 below the scene's lights and looks down on [-1, 1]^2 from 0.1 m above it. Is each quarter of
// the picture on average albedo E / pi?
testing::AssertionResult shows_on_floor(Scene scene, const FloorIrradiance& irradiance, double alpha = statistics::significance,
                                        RenderSettings settings = settings_for(16, 16, 64));

} // namespace blush::test
