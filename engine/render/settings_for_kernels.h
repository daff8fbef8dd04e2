// From the settings a user makes to those a kernel reads.
#pragma once

#include "render/estimator_settings.h"

namespace blush {

// For a film of width x height pixels. Tables it points to live as long as the program.
EstimatorSettings settings_for_kernels(const RenderSettings& settings, int width, int height);

} // namespace blush
