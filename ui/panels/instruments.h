// The instruments: panels that measure, compare or analyse the image, or list its lights and edits. They open in the docks
// beside it.
#pragma once

#include "ui/instrument.h"

#include <span>
#include <string>

namespace blush {

// All instruments of Blush.
std::span<const Instrument> instruments();

// Opens it; or brings its tab to the front if it is hidden; or closes it if it is visible.
void toggle_instrument(PanelContext& c, const std::string& id);

// Opens the instruments that were open when the scene was last closed.
void restore_instruments(PanelContext c, const std::string& file);

} // namespace blush
