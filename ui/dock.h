// Where instruments open: on which side of the viewport, in which order, which is in front, and which float in windows of their own.
#pragma once

#include "ui/layout.h"

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

// What is remembered of the docks, for all scenes.
struct Dock {
    DockSizes sizes;
    std::vector<DockTab> tabs;        // in their order; of instruments that were never opened there is none
    std::array<std::string, 2> front; // by side: the id of the tab that is shown
    bool operator==(const Dock&) const = default;
};

// The place of an instrument; at the end of its side if it has none yet.
DockTab& place_of(Dock& dock, const std::string& id, DockSide side_at_first);

// Those of the open instruments that are docked on a side, in their order. Without a right dock all are at the bottom.
std::vector<std::string> tabs_on(const Dock& dock, DockSide side, std::span<const std::string> open, bool has_right_dock);
std::vector<std::string> floating(const Dock& dock, std::span<const std::string> open);

// `shown` are tabs of one side as they lie on the screen: the tabs take that order, others keep their places.
void reorder(Dock& dock, std::span<const std::string> shown);

// The docks as they are on the screen; not remembered.
struct DockView {
    std::vector<std::string> open;  // in the last frame
    std::set<std::string> in_sight; // those of them that are not behind another tab
    std::set<std::string> to_front; // asked for
    std::string torn_off;           // just now: the mouse goes on moving it
    std::string moved;              // the floating window that the mouse moves
};

} // namespace blush
