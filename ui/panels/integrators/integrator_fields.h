// The knobs of a biased integrator.
#pragma once

#include "render/biased/biased_integrator.h"
#include "ui/widgets/widgets.h"

#include <vector>

namespace blush {

enum class IntegratorKnob { ao_distance, automatic_color, color, accuracy, rays, grid, photons, radius, gather_rays, alpha };

// Those that this integrator has now.
std::vector<IntegratorKnob> integrator_knobs(const BiasedIntegrator& integrator);
void draw_integrator_knob(Fields& f, BiasedIntegrator& integrator, IntegratorKnob knob);
// Chooses another kind with its defaults.
void choose_integrator(BiasedIntegrator& integrator, BiasedIntegrator::Kind kind);

} // namespace blush
