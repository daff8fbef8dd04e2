// Draws the panels round the picture and the windows above it, in their order.
#pragma once

#include "ui/layout.h"
#include "ui/panels/context.h"

namespace blush {

// The layout of a window of this size, with the docks that hold something.
Layout window_layout(PanelContext& c, float width, float height);

// Outliner, time row and inspector in their regions, then the docks of the instruments. Panels change lights: they come before the picture,
// so that it shows their edits in the same frame.
void draw_side_panels(PanelContext& c, const Layout& layout);

} // namespace blush
