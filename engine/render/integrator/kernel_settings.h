// Converts render settings to the settings that kernels read.
#pragma once

#include "render/integrator/estimator_settings.h"

namespace blush {

// For a film of width x height pixels. Tables it points to have static lifetime.
EstimatorSettings kernel_settings(const RenderSettings& settings, int width, int height);

} // namespace blush
