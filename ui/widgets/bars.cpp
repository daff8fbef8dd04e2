#include "ui/widgets/bars.h"

#include "ui/widgets/tooltip.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>

namespace blush {

int draw_bars(UiState& ui, const char* scope, std::span<const Bar> bars, const char* tip) {
    const float em = ImGui::GetFontSize(), height = std::round(em * 1.35f), gap = em * 0.5f;
    float figure_width = em * 5;
    for (const Bar& bar : bars) figure_width = std::max(figure_width, ImGui::CalcTextSize(bar.figure.c_str()).x);
    const float width = ImGui::GetContentRegionAvail().x, name_width = em * 5.5f;
    const float room = std::max(em, width - name_width - figure_width - 2 * gap);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    int clicked = -1;
    for (size_t i = 0; i < bars.size(); ++i) {
        const Bar& bar = bars[i];
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::PushID(int(i));
        if (ImGui::InvisibleButton("bar", {width, height})) clicked = int(i);
        ImGui::PopID();
        ui.probe.record_last_item(std::string(scope) + "/" + bar.name);
        const bool hovered = ImGui::IsItemHovered();
        tip_for_last_item(ui, tip);
        const float left = at.x + name_width + gap, top = at.y + height * 0.2f, bottom = at.y + height * 0.8f,
                    text = at.y + (height - em) / 2;
        draw.AddText({at.x, text}, bar.chosen || hovered ? tone::text : tone::dim_text, bar.name.c_str());
        draw.AddRectFilled({left, top}, {left + room, bottom}, tone::line);
        draw.AddRectFilled({left, top}, {left + room * float(std::clamp(bar.share, 0.0, 1.0)), bottom},
                           bar.chosen ? tone::text
                           : hovered  ? tone::dim_text
                                      : tone::field_filled);
        const float figure = ImGui::CalcTextSize(bar.figure.c_str()).x;
        draw.AddText({at.x + width - figure, text}, tone::text, bar.figure.c_str());
    }
    return clicked;
}

} // namespace blush
