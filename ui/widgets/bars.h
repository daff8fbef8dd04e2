// Horizontal bars, with a name before and a value after each.
#pragma once

#include "ui/window/ui_state.h"

#include <span>
#include <string>

namespace blush {

struct Bar {
    std::string name;
    double share = 0; // fraction of the full width, 0 .. 1
    std::string figure;
    bool chosen = false;
};

// Returns the index of the clicked bar, or -1. `scope`: prefix of the names in the probe.
int draw_bars(UiState& ui, const char* scope, std::span<const Bar> bars, const char* tip);

} // namespace blush
