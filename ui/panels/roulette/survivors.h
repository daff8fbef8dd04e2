// The section of the Roulette lab that shows survivors path by path.
#pragma once

#include "ui/panel_context.h"

namespace blush {

void draw_survivors(PanelContext& c);
// Its lower part, without its jobs: the paths as marks, and the sums of the lesson.
void draw_survivor_paths(PanelContext& c, const PathSet& with_roulette, const PathSet* without);

} // namespace blush
