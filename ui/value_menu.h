// Copying, pasting and resetting values: by the menu of a field's right click, or by keys over it.
#pragma once

#include "ui/ui_state.h"

#include <string>

namespace blush {

// From the next frame on, for that frame: what a key asks of the field under the mouse.
void wish_of_value(UiState& ui, ValueWish wish);

// What the user asks of the last item, which was drawn for a value of that name: by a key, or in the menu that a right click opens.
ValueWish value_wish(UiState& ui, const std::string& name, bool is_color, bool has_siblings);

// What was copied elsewhere; empty: nothing, or more than a value can be.
std::string pasted_text();
void copy_text(UiState& ui, const std::string& text);
// Says that the text on the clipboard is none of what the field takes.
void refuse_pasted(UiState& ui, const std::string& field, const char* wanted);

} // namespace blush
