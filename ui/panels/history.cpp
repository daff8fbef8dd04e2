// History panel: the undo and redo steps. A click goes to a step.
#include "ui/panels/panels.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/tooltip.h"
#include "ui/window/theme.h"

#include <fmt/format.h>

namespace blush {

void draw_history(PanelContext& c) {
    const std::vector<std::string> past = c.document.undo_labels(), future = c.document.redo_labels();
    ptrdiff_t steps = 0; // steps to go: negative undoes
    const float room = ImGui::GetContentRegionAvail().x;
    const auto step = [&](const std::string& label, bool current, const std::string& id) {
        const std::string shown = elided(label, room);
        const bool pressed = ImGui::Selectable((shown + "##" + id).c_str(), current);
        if (shown != label) tip_for_last_item(c.ui, label.c_str());
        return pressed;
    };
    if (step("As opened", past.empty(), "opened")) steps = -ptrdiff_t(past.size());
    for (size_t i = 0; i < past.size(); ++i) {
        const bool current = i + 1 == past.size();
        if (step(past[i], current, fmt::format("past{}", i))) steps = ptrdiff_t(i + 1) - ptrdiff_t(past.size());
        if (current && ImGui::IsWindowAppearing()) ImGui::SetScrollHereY();
    }
    ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
    for (size_t i = 0; i < future.size(); ++i) {
        if (step(future[i], false, fmt::format("future{}", i))) steps = ptrdiff_t(i + 1);
    }
    ImGui::PopStyleColor();
    for (; steps < 0; ++steps) c.document.undo();
    for (; steps > 0; --steps) c.document.redo();
}

} // namespace blush
