// The docks of the instruments, to the right of the image and below it, and floating windows.
#pragma once

#include "ui/instrument.h"

#include <span>

namespace blush {

// Returns which docks have content for a window with this room, and their sizes. Call once per frame, before the layout is
// computed.
ViewportInsets dock_insets(PanelContext& c, std::span<const Instrument> instruments, const Region& room);

// Draws the open ones of the same instruments: docked ones in their regions, the others in floating windows.
void draw_docks(PanelContext& c, std::span<const Instrument> instruments, const Layout& layout);

// Docks all floating windows.
void dock_all(Dock& dock);

} // namespace blush
