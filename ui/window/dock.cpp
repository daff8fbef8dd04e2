#include "ui/window/dock.h"

#include <algorithm>

namespace blush {

DockTab& place_of(Dock& dock, const std::string& id, DockSide side_at_first) {
    const auto found = std::ranges::find(dock.tabs, id, &DockTab::id);
    if (found != dock.tabs.end()) return *found;
    return dock.tabs.emplace_back(DockTab{id, side_at_first, false});
}

std::vector<std::string> tabs_on(const Dock& dock, DockSide side, std::span<const std::string> open, bool has_right_dock) {
    std::vector<std::string> ids;
    for (const DockTab& tab : dock.tabs) {
        const DockSide shown_on = has_right_dock ? tab.side : DockSide::bottom;
        if (!tab.floats && shown_on == side && std::ranges::count(open, tab.id) > 0) ids.push_back(tab.id);
    }
    return ids;
}

std::vector<std::string> floating(const Dock& dock, std::span<const std::string> open) {
    std::vector<std::string> ids;
    for (const DockTab& tab : dock.tabs)
        if (tab.floats && std::ranges::count(open, tab.id) > 0) ids.push_back(tab.id);
    return ids;
}

void reorder(Dock& dock, std::span<const std::string> shown) {
    std::vector<DockTab> sorted;
    for (const std::string& id : shown) {
        const auto found = std::ranges::find(dock.tabs, id, &DockTab::id);
        if (found != dock.tabs.end()) sorted.push_back(*found);
    }
    auto next = sorted.begin();
    for (DockTab& tab : dock.tabs)
        if (std::ranges::count(shown, tab.id) > 0 && next != sorted.end()) tab = *next++;
}

} // namespace blush
