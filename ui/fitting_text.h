// Text that is too long for its place: shortened to an ellipsis, whole in a tooltip.
#pragma once

#include "ui/ui_state.h"

#include <imgui.h>

#include <string>

namespace blush {

// The beginning of the text, with an ellipsis in place of what does not fit into so many pixels of the current font; whole characters of
// UTF-8. The text itself if it fits. What follows `##` is not drawn and does not count.
std::string elided(const std::string& text, float width);

// A line in what the row has left, or in `width` pixels; where it is shortened, a tooltip has all of it.
void fitting_text(UiState& ui, const std::string& text, ImU32 color, float width = 0);

// As ImGui::InputText over the width of the next item; while it is not being edited, text that is too long ends in an ellipsis.
bool fitting_input(UiState& ui, const char* id, std::string& text, ImGuiInputTextFlags flags = 0);

// Goes on in the row of the last item if so many pixels fit, `gap` pixels from it; else the next item begins a row. A gap below 0 is the
// usual one.
void same_line_if_fits(float width, float gap = -1);

} // namespace blush
