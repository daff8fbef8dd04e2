// The list of runs in the Convergence panel.
#pragma once

#include "ui/panels/context.h"

namespace blush {

// A line for each run, which is its legend too: shown or not, name, figures, kept, removed. Scrolls within `height` pixels.
void draw_convergence_runs(PanelContext& c, ConvergenceView& view, float height);

} // namespace blush
