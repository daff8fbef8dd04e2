// Dock layout of the instruments: side, tab order, front tab, and which are floating windows.
#pragma once

#include "ui/window/layout.h"

#include <array>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace blush {

// An instrument's place, kept while it is closed.
struct DockTab {
    std::string id;
    DockSide side = DockSide::right;
    bool floats = false;
    bool operator==(const DockTab&) const = default;
};

// The saved layout, for all scenes.
struct Dock {
    DockSizes sizes;
    std::vector<DockTab> tabs;        // in order; instruments that were never opened are not included
    std::array<std::string, 2> front; // per side: the id of the front tab
    bool operator==(const Dock&) const = default;
};

// The tab of an instrument; new ones are added at the end of their side.
DockTab& place_of(Dock& dock, const std::string& id, DockSide side_at_first);

// The open instruments docked on a side, in order. Without a right dock all are at the bottom.
std::vector<std::string> tabs_on(const Dock& dock, DockSide side, std::span<const std::string> open, bool has_right_dock);
std::vector<std::string> floating(const Dock& dock, std::span<const std::string> open);

// `shown` are the tabs of one side in their order on the screen: they take that order, other tabs keep their places.
void reorder(Dock& dock, std::span<const std::string> shown);

// The state of the docks on the screen; not saved.
struct DockView {
    std::vector<std::string> open;  // in the last frame
    std::set<std::string> in_sight; // those that are not behind another tab
    std::set<std::string> to_front; // requested to come to the front
    std::string torn_off;           // just torn off: the mouse continues to move it
    std::string moved;              // the floating window that the mouse moves
};

} // namespace blush
