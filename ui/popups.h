// Menus, lists of choices, colour pickers and dialogs that are open: ImGui's stack of popups.
#pragma once

namespace blush {

bool any_popup_open();
// Closes the popup that was opened last. False: none is open.
bool close_top_popup();

} // namespace blush
