// Converts reflected radiance to illuminance.
#pragma once

#include "core/vec.h"

#include <span>

namespace blush {

// Replaces scene-linear `rgb`, 3 values per pixel, in place by grey values of illuminance in lux: pi Y / Y(albedo), which is
// valid for Lambertian surfaces. 0 where the albedo's luminance is below 0.01: background, or a black surface.
void to_illuminance(std::span<float> rgb, std::span<const Vec3> albedo);

} // namespace blush
