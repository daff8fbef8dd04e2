// Draws the panels around the image and the windows above it, in their order.
#pragma once

#include "ui/panel_context.h"
#include "ui/window/layout.h"

namespace blush {

// The layout for a window of this size, with the docks that have content.
Layout window_layout(PanelContext& c, float width, float height);

// Draws outliner, timeline and inspector in their regions, then the docks. Panels change lights, so they come before the image,
// which then shows the edits in the same frame.
void draw_side_panels(PanelContext& c, const Layout& layout);

} // namespace blush
