// From the light that surfaces send back to the light that falls on them.
#pragma once

#include "core/vec.h"

#include <span>

namespace blush {

// Scene-linear `rgb`, 3 values a pixel, becomes grey of illuminance in lux, in place: pi Y / Y(albedo), which holds for what a Lambertian
// surface reflects. 0 where the albedo's luminance is below a hundredth: nothing, black, or metal seen as such.
void to_illuminance(std::span<float> rgb, std::span<const Vec3> albedo);

} // namespace blush
