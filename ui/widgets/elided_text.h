// Text that is too long for its place: shortened with an ellipsis, in full in a tooltip.
#pragma once

#include "ui/window/ui_state.h"

#include <imgui.h>

#include <string>

namespace blush {

// The beginning of the text, with an ellipsis if it does not fit into `width` pixels of the current font. Does not split UTF-8
// characters. Text after `##` is not drawn and does not count.
std::string elided(const std::string& text, float width);

// As elided(), but with the beginning and the end of the text, for paths and file names.
std::string elided_middle(const std::string& text, float width);

// A line of text in the rest of the row, or in `width` pixels. If it is shortened, a tooltip shows all of it.
void elided_text(UiState& ui, const std::string& text, ImU32 color, float width = 0);

// As ImGui::InputText with the width of the next item; while it is not edited, text that is too long ends with an ellipsis.
bool elided_input(UiState& ui, const char* id, std::string& text, ImGuiInputTextFlags flags = 0);
// The same for a path: its middle is left out. `complete` is called for the Tab key.
bool elided_path_input(UiState& ui, const char* id, std::string& path, ImGuiInputTextFlags flags, ImGuiInputTextCallback complete,
                       void* data);

// Continues the row of the last item if `width` pixels fit after `gap` pixels; else the next item begins a new row. A negative
// gap is the default gap.
void same_line_if_fits(float width, float gap = -1);

} // namespace blush
