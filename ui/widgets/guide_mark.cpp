#include "ui/widgets/guide_mark.h"

#include "ui/widgets/tooltip.h"
#include "ui/window/theme.h"

#include <imgui_internal.h> // the title bar

namespace blush {
namespace {

constexpr const char* mark = "?";
constexpr const char* tip = "Opens the page of the guide about this part of the window in the browser.";

void draw_mark(const ImVec2& low, const ImVec2& size, bool hovered) {
    const ImVec2 text = ImGui::CalcTextSize(mark);
    ImGui::GetWindowDrawList()->AddText({low.x + (size.x - text.x) / 2, low.y + (size.y - text.y) / 2},
                                        hovered ? tone::text : tone::dim_text, mark);
}

} // namespace

float guide_mark_width() { return ImGui::GetFrameHeight(); }

void guide_mark(UiState& ui, const std::string& name, const char* page, float height) {
    const ImVec2 low = ImGui::GetCursorScreenPos(), size{guide_mark_width(), height};
    if (ImGui::InvisibleButton(mark, size)) ui.guide_page = page;
    ui.probe.record_last_item(name);
    draw_mark(low, size, ImGui::IsItemHovered());
    tip_for_last_item(ui, tip);
}

void guide_mark_in_title_bar(UiState& ui, const std::string& name, const char* page) {
    ImGuiWindow& window = *ImGui::GetCurrentWindow();
    const ImRect bar = window.TitleBarRect();
    const float side = bar.GetHeight();
    const ImRect box({bar.Max.x - 2 * side, bar.Min.y}, {bar.Max.x - side, bar.Max.y});
    const ImGuiID id = window.GetID(mark);
    ImGui::PushClipRect(bar.Min, bar.Max, false);
    bool hovered = false, held = false;
    if (ImGui::ItemAdd(box, id) && ImGui::ButtonBehavior(box, id, &hovered, &held)) ui.guide_page = page;
    draw_mark(box.Min, box.GetSize(), hovered);
    ImGui::PopClipRect();
    ui.probe.record(name, {box.Min.x, box.Min.y, side, side});
}

} // namespace blush
