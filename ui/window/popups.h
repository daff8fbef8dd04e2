// Open popups (menus, combo boxes, colour pickers, dialogs): ImGui's popup stack.
#pragma once

namespace blush {

bool any_popup_open();
// Closes the most recent popup. False if none is open.
bool close_top_popup();

} // namespace blush
