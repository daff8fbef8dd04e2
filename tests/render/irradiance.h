// The test that a picture of a matte floor shows the irradiance of a closed form.
#pragma once

#include "measure/stability/irradiance.h"
#include "picture.h"
#include "scenes.h"

namespace blush::test {

// Is each quarter of a photograph of the floor on average what the irradiance says?
testing::AssertionResult shows_on_floor(const Scene& scene, const FloorIrradiance& irradiance, double alpha = statistics::significance,
                                        const RenderSettings& settings = settings_for(16, 16, 64));

} // namespace blush::test
