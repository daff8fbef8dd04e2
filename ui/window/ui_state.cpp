#include "ui/window/ui_state.h"

#include <algorithm>

namespace blush {

void UiState::toggle(Id<Node> node) {
    tab = InspectorTab::selection;
    selected_material = {};
    if (std::erase(also_selected, node)) return;
    if (selected != node) {
        if (selected) also_selected.push_back(selected);
        selected = node;
        scroll_to_selected = true;
        return;
    }
    selected = {};
    if (also_selected.empty()) return;
    selected = also_selected.back();
    also_selected.pop_back();
}

void UiState::select_range(std::span<const Id<Node>> listed, Id<Node> to) {
    const auto from = std::ranges::find(listed, selected), end = std::ranges::find(listed, to);
    if (from == listed.end() || end == listed.end()) return select(to);
    const Id<Node> start = selected;
    const auto [low, high] = std::minmax(from, end);
    also_selected.assign(low, high + 1);
    std::erase(also_selected, start);
}

bool UiState::is_selected(Id<Node> node) const { return node && (node == selected || std::ranges::count(also_selected, node) > 0); }

std::vector<Id<Node>> UiState::selection(const Scene& scene) const {
    std::vector<Id<Node>> nodes{selected};
    nodes.insert(nodes.end(), also_selected.begin(), also_selected.end());
    std::erase_if(nodes, [&](Id<Node> id) { return !scene.nodes.contains(id); });
    return nodes;
}

} // namespace blush
