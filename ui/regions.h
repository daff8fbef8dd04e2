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

// Lets the mouse drag the bars beside outliner, inspector and docks; double-click puts them back. To be called before the regions are begun, in
// every frame: of windows that stay behind others, those that were made first lie in front. So the bars lie over the regions and under all else.
void drag_splitters(UiState& ui, const Layout& layout, float window_width);

} // namespace blush
