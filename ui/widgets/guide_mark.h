// The "?" of a panel, which opens the panel's page of the guide in the browser. Always in the panel's upper right corner, in bars at
// their right end.
#pragma once

#include "ui/window/ui_state.h"

#include <imgui.h>
#include <string>

namespace blush {

// Pages about the parts of the window that are no instruments and no tabs of the inspector.
namespace guide_page {
constexpr const char* outliner = "guide/first-steps.html#outliner";
constexpr const char* viewport = "guide/first-steps.html#viewport";
constexpr const char* status_bar = "guide/first-steps.html#status-bar";
constexpr const char* timeline = "guide/first-steps.html#what-a-file-offers";
constexpr const char* snapshot_strip = "guide/snapshots.html#keep";
constexpr const char* file_browser = "guide/first-steps.html#file-browser";
constexpr const char* shortcuts = "guide/first-steps.html";
constexpr const char* all[] = {outliner, viewport, status_bar, timeline, snapshot_strip, file_browser, shortcuts};
} // namespace guide_page

// Width of the mark: pixels.
float guide_mark_width();

// An item of this height at the cursor. `name` is its name in the probe.
void guide_mark(UiState& ui, const std::string& name, const char* page, float height);

// In the title bar of the current window, to the left of the button that closes it.
void guide_mark_in_title_bar(UiState& ui, const std::string& name, const char* page);

} // namespace blush
