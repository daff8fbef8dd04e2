// The fixed regions of the window as ImGui windows, with splitters between them.
#pragma once

#include "ui/window/ui_state.h"

namespace blush {

struct RegionStyle {
    bool padded = true;     // false for content that reaches the edges
    bool background = true; // false for content that covers the whole region
};
// Begins a window that fills a region exactly; end with end_region().
void begin_region(const char* name, const Region& region, const RegionStyle& style = {});
void end_region();

// Handles the splitters of outliner, inspector and docks; double-click resets them. Call in every frame before the regions are
// begun: among background windows, the first created is in front. So the splitters are above the regions and below all other
// windows.
void drag_splitters(UiState& ui, const Layout& layout, float window_width);

} // namespace blush
