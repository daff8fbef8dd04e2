// The docks of the instruments: tabs on the right of the picture and below it, and what was torn off them.
#pragma once

#include "ui/panels/instruments.h"

namespace blush {

// The docks that hold something in a window with this room, and their sizes. Call it once a frame, before the layout is made.
Beside docks_beside(PanelContext& c, const Region& room);

// Draws the instruments that are open: docked ones in their regions, the others in windows of their own.
void draw_docks(PanelContext& c, const Layout& layout);

// Puts all that was torn off back into the docks.
void dock_all(Dock& dock);

} // namespace blush
