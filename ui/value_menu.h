// Copy, paste and reset of values, by the context menu of a field or by keys.
#pragma once

#include "ui/ui_state.h"

#include <string>

namespace blush {

// Requests the action for the field under the mouse, for the next frame.
void wish_of_value(UiState& ui, ValueWish wish);

// The action requested for the last item, a field with this name: by a key, or in its context menu.
ValueWish value_wish(UiState& ui, const std::string& name, bool is_color, bool has_siblings);

// The clipboard's text; empty if there is none or it is too long.
std::string pasted_text();
void copy_text(UiState& ui, const std::string& text);
// Shows a warning that the field cannot use the clipboard's text.
void refuse_pasted(UiState& ui, const std::string& field, const char* wanted);

} // namespace blush
