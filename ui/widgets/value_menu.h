// Copy, paste and reset of values, by the context menu of a field or by keys.
#pragma once

#include "ui/window/ui_state.h"

#include <string>

namespace blush {

// Requests the action for the field under the mouse, for the next frame.
void request_value_action(UiState& ui, ValueAction requested);

// The action requested for the last item, a field with this name: by a key, or in its context menu.
ValueAction value_action(UiState& ui, const std::string& name, bool is_color, bool has_siblings);

// The clipboard's text; empty if there is none or it is too long.
std::string pasted_text();
void copy_text(UiState& ui, const std::string& text);
// Shows a warning that the field cannot use the clipboard's text.
void warn_invalid_paste(UiState& ui, const std::string& field, const char* wanted);

} // namespace blush
