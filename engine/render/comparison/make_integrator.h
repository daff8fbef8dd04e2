// Makes the integrators for comparison.
#pragma once

#include "render/comparison/comparison_integrator.h"
#include "render/comparison/indirect_light.h"

#include <memory>

namespace blush {

// Null for path tracing.
std::unique_ptr<PathReplacement> make_integrator(const ComparisonIntegrator& integrator);

} // namespace blush
