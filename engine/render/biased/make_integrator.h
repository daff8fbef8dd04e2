// Makes the integrators for comparison.
#pragma once

#include "render/biased/biased_integrator.h"
#include "render/biased/indirect_light.h"

#include <memory>

namespace blush {

// Null for path tracing.
std::unique_ptr<PathReplacement> make_integrator(const BiasedIntegrator& integrator);

} // namespace blush
