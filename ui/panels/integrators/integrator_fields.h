// The knobs of an integrator for comparison.
#pragma once

#include "render/comparison/comparison_integrator.h"
#include "ui/widgets/widgets.h"

#include <vector>

namespace blush {

enum class IntegratorKnob {
    ao_distance,
    automatic_color,
    color,
    accuracy,
    rays,
    grid,
    photons,
    radius,
    gather_rays,
    alpha,
    large_steps,
    chain,
    baked
};

// Those that this integrator has now.
std::vector<IntegratorKnob> integrator_knobs(const ComparisonIntegrator& integrator);
void draw_integrator_knob(Fields& f, ComparisonIntegrator& integrator, IntegratorKnob knob);
// Chooses another kind with its defaults.
void choose_integrator(ComparisonIntegrator& integrator, ComparisonIntegrator::Kind kind);

} // namespace blush
