// The parts of the panel of the path tool.
#pragma once

#include "ui/panel_context.h"

namespace blush {

// The shown path as arithmetic: a row for each vertex, and below it what the path received there.
void draw_path_arithmetic(PanelContext& c, const RecordedPath& path);
// The mean of all paths, how it settles, and what it is made of.
void draw_path_average(PanelContext& c, const PathSet& set);

} // namespace blush
