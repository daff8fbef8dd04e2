#include "ui/widgets/segments.h"

#include "ui/widgets/elided_text.h"
#include "ui/widgets/tooltip.h"
#include "ui/window/theme.h"

#include <fmt/format.h>
#include <imgui.h>

namespace blush {
namespace {

constexpr float segment_gap = 1; // pixels

} // namespace

int segments(UiState& ui, const char* scope, std::span<const char* const> names, int chosen, const char* tip) {
    int i = 0, result = chosen;
    for (const char* name : names) {
        if (i > 0) same_line_if_fits(segments_width({&name, 1}), segment_gap);
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(i == chosen ? ImGuiCol_ButtonActive : ImGuiCol_FrameBg));
        ImGui::PushStyleColor(ImGuiCol_Text, i == chosen ? tone::text : tone::dim_text);
        if (ImGui::Button(name)) result = i;
        ImGui::PopStyleColor(2);
        ui.probe.record_last_item(fmt::format("{}/{}", scope, name));
        tip_for_last_item(ui, tip);
        ++i;
    }
    return result;
}

float segments_width(std::span<const char* const> names) {
    float width = 0;
    for (const char* name : names) width += ImGui::CalcTextSize(name).x + 2 * ImGui::GetStyle().FramePadding.x + segment_gap;
    return width;
}

} // namespace blush
