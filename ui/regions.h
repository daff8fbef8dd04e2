// The fixed regions of the window as ImGui windows, and the bars between them.
#pragma once

#include "ui/ui_state.h"

namespace blush {

struct RegionStyle {
    bool padded = true;     // false for what draws to its edges
    bool background = true; // false for what covers all of it
};
// Begins a window that fills a region exactly; end it with end_region().
void begin_region(const char* name, const Region& region, const RegionStyle& style = {});
void end_region();

// Lets the mouse drag the bars beside outliner, inspector and docks; double-click puts them back.
void drag_splitters(UiState& ui, const Layout& layout, float window_width);

} // namespace blush
