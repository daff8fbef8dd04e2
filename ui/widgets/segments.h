// A segmented control: buttons side by side, one of which is chosen.
#pragma once

#include "ui/window/ui_state.h"

#include <span>

namespace blush {

// Returns the index of the clicked button, or `chosen`. Buttons that do not fit begin a new row. `scope`: prefix of the names in the
// probe. The names are also ImGui ids.
int segments(UiState& ui, const char* scope, std::span<const char* const> names, int chosen, const char* tip);
// Its width in pixels.
float segments_width(std::span<const char* const> names);

} // namespace blush
