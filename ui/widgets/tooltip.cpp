#include "ui/widgets/tooltip.h"

#include "ui/widgets/wrapped_text.h"

#include <algorithm>

namespace blush {
namespace {

constexpr double tip_delay = 0.5; // seconds

// The tooltip is beside the widget's window if that is near, else above or beside the widget: never over the row below.
ImVec2 place_tip(const ImVec2& low, const ImVec2& high, const ImVec2& size) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize, at = ImGui::GetWindowPos();
    const float em = ImGui::GetFontSize(), gap = em / 3, near = em * 14, edge = at.x + ImGui::GetWindowWidth();
    const auto inside = [&](float y) { return std::clamp(y, 0.f, std::max(0.f, screen.y - size.y)); };
    const auto fits = [&](float x) { return x >= 0 && x + size.x <= screen.x; };
    if (const float x = at.x - gap - size.x; low.x - at.x < near && fits(x)) return {x, inside(low.y)};
    if (const float x = edge + gap; edge - high.x < near && fits(x)) return {x, inside(low.y)};
    const float x = std::clamp(low.x, 0.f, std::max(0.f, screen.x - size.x)), above = low.y - gap - size.y;
    if (above >= 0) return {x, above};
    for (const float beside : {high.x + gap, low.x - gap - size.x})
        if (fits(beside)) return {beside, inside(low.y)};
    return {x, high.y + gap};
}

} // namespace

bool tip_is_due(UiState& ui) {
    if (!ImGui::IsItemHovered() || ImGui::IsAnyMouseDown()) return false;
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const Region item{low.x, low.y, high.x - low.x, high.y - low.y};
    const int frame = ImGui::GetFrameCount();
    if (ui.tip.item != item || frame > ui.tip.frame + 1) ui.tip = {item, ImGui::GetTime(), frame};
    ui.tip.frame = frame;
    const double rested = ImGui::GetTime() - ui.tip.since;
    if (rested < tip_delay) ui.seconds_to_next_frame = std::min(ui.seconds_to_next_frame, tip_delay - rested);
    return rested >= tip_delay;
}

void place_next_tip(const ImVec2& size) { ImGui::SetNextWindowPos(place_tip(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), size)); }

void tip_for_last_item(UiState& ui, const char* tip) {
    if (!*tip || !tip_is_due(ui)) return;
    const float wrap = ImGui::GetFontSize() * 24;
    const std::string lines = wrapped(tip, wrap);
    const ImVec2 text = ImGui::CalcTextSize(lines.c_str(), nullptr, false, wrap), padding = ImGui::GetStyle().WindowPadding;
    place_next_tip({text.x + 2 * padding.x, text.y + 2 * padding.y});
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(padding.x + wrap); // for words that are longer than a line
    ImGui::TextUnformatted(lines.c_str());
    ImGui::PopTextWrapPos();
    ui.probe.record("Tooltip", {ImGui::GetWindowPos().x, ImGui::GetWindowPos().y, ImGui::GetWindowWidth(), ImGui::GetWindowHeight()});
    ImGui::EndTooltip();
}

} // namespace blush
