// The list of runs in the Convergence panel.
#pragma once

#include "ui/panel_context.h"

namespace blush {

// One row per run, which is also the legend: visibility, name, values, Keep, Remove. Scrolls within `height` pixels.
void draw_convergence_runs(PanelContext& c, ConvergenceView& view, float height);

} // namespace blush
