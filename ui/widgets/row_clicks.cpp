#include "ui/widgets/row_clicks.h"

#include <imgui.h>

namespace blush {

void RowClicks::row(Id<Node> node, bool clicked, Id<Material> material) {
    listed_.push_back(node);
    if (!clicked) return;
    clicked_ = node;
    material_ = material;
}

void RowClicks::finish(UiState& ui) const {
    if (!clicked_) return;
    if (ImGui::GetIO().KeyShift) return ui.select_range(listed_, clicked_);
    if (ImGui::GetIO().KeyCtrl) return ui.toggle(clicked_);
    ui.select(clicked_, material_);
}

} // namespace blush
