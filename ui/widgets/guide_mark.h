// The "?" of a panel, which opens the panel's page of the guide in the browser. Always in the panel's upper right corner, in bars at
// their right end.
#pragma once

#include "ui/widgets/guide_pages.h"
#include "ui/window/ui_state.h"

#include <imgui.h>
#include <string>

namespace blush {

// Width of the mark: pixels.
float guide_mark_width();

// An item of this height at the cursor. `name` is its name in the probe.
void guide_mark(UiState& ui, const std::string& name, const char* page, float height);

// In the title bar of the current window, to the left of the button that closes it.
void guide_mark_in_title_bar(UiState& ui, const std::string& name, const char* page);

} // namespace blush
