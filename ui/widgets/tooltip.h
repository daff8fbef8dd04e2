// Tooltips of widgets: when they appear, and where.
#pragma once

#include "ui/window/ui_state.h"

#include <imgui.h>

namespace blush {

// A tooltip for the last item, after the tooltip delay.
void tip_for_last_item(UiState& ui, const char* tip);
// True if the mouse has been over the last item for the tooltip delay; requests the frame in which that becomes true.
bool tip_is_due(UiState& ui);
// Places a tooltip of this size beside the window of the last item, never over the row below.
void place_next_tip(const ImVec2& size);

} // namespace blush
