// State of ImGui that its public interface does not expose: the stack of open popups (menus, combo boxes, colour pickers, dialogs), and
// whether it has settled.
#pragma once

namespace blush {

bool any_popup_open();
// Arrow keys, Enter and Space work in menus, combo boxes and other popups, as long as one is open; otherwise they are shortcuts.
// Modal dialogs handle keys themselves. Call it before ImGui::NewFrame().
void navigate_popups_by_keys();
// Closes the most recent popup. False if none is open.
bool close_top_popup();

// True if the frame that was just built needs another one to have its effect: a new window is only measured yet and not shown, the
// keyboard goes to a text field, or a row of tabs scrolls. Call it before ImGui::Render() or after.
bool needs_another_frame();

} // namespace blush
