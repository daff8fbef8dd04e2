// Horizontal bars with a name before and a figure behind each.
#pragma once

#include "ui/ui_state.h"

#include <span>
#include <string>

namespace blush {

struct Bar {
    std::string name;
    double share = 0; // of the full width, 0 .. 1
    std::string figure;
    bool chosen = false;
};

// The index of the bar that was clicked, or -1. `scope`: before the names in the probe.
int draw_bars(UiState& ui, const char* scope, std::span<const Bar> bars, const char* tip);

} // namespace blush
