// History: the steps taken and undone; a click goes there.
#include "ui/panels/panels.h"
#include "ui/theme.h"

#include <fmt/format.h>

namespace blush {

void draw_history(PanelContext& c) {
    if (!c.ui.show_history) return;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({em * 16, em * 4}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize({em * 18, em * 22}, ImGuiCond_FirstUseEver);
    if (ImGui::Begin("History", &c.ui.show_history, ImGuiWindowFlags_NoCollapse)) {
        const std::vector<std::string> past = c.document.undo_labels(), future = c.document.redo_labels();
        ptrdiff_t steps = 0; // to go: negative undoes
        if (ImGui::Selectable("As opened", past.empty())) steps = -ptrdiff_t(past.size());
        for (size_t i = 0; i < past.size(); ++i) {
            const bool current = i + 1 == past.size();
            if (ImGui::Selectable(fmt::format("{}##past{}", past[i], i).c_str(), current))
                steps = ptrdiff_t(i + 1) - ptrdiff_t(past.size());
            if (current && ImGui::IsWindowAppearing()) ImGui::SetScrollHereY();
        }
        ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
        for (size_t i = 0; i < future.size(); ++i) {
            if (ImGui::Selectable(fmt::format("{}##future{}", future[i], i).c_str())) steps = ptrdiff_t(i + 1);
        }
        ImGui::PopStyleColor();
        for (; steps < 0; ++steps) c.document.undo();
        for (; steps > 0; --steps) c.document.redo();
    }
    ImGui::End();
}

} // namespace blush
