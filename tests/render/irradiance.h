// Checks that an image of a diffuse floor shows the irradiance of a closed form.
#pragma once

#include "measure/stability/irradiance.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test {

// True if the mean of each quarter of an image of the floor matches the irradiance.
testing::AssertionResult shows_on_floor(const Scene& scene, const FloorIrradiance& irradiance, double alpha = statistics::significance,
                                        const RenderSettings& settings = settings_for(16, 16, 64));

} // namespace blush::test
