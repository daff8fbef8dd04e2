#include "ui/regions.h"

#include "ui/theme.h"

#include <imgui.h>

namespace blush {
namespace {

// A bar at x, over the edge of two regions. True while it is dragged or was double-clicked.
bool draw_splitter(UiState& ui, const char* id, float x, const Region& beside, bool& reset) {
    const float grab = std::max(6.f, ImGui::GetFontSize() * 0.5f);
    ImGui::SetNextWindowPos({x - grab / 2, beside.y});
    ImGui::SetNextWindowSize({grab, beside.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::Begin(id, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBackground |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
    ImGui::InvisibleButton("bar", {grab, beside.height});
    ui.probe.record_last_item(std::string("Splitter/") + id);
    const bool active = ImGui::IsItemActive();
    if (active || ImGui::IsItemHovered()) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        ImGui::GetWindowDrawList()->AddRectFilled({x - 1, beside.y}, {x + 1, beside.y + beside.height},
                                                  active ? tone::text : tone::dim_text);
    } else {
        ImGui::GetWindowDrawList()->AddLine({x, beside.y}, {x, beside.y + beside.height}, tone::line);
    }
    reset = ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    ImGui::End();
    ImGui::PopStyleVar(2);
    return active;
}

} // namespace

void begin_region(const char* name, const Region& region, const RegionStyle& style) {
    ImGui::SetNextWindowPos({region.x, region.y});
    ImGui::SetNextWindowSize({region.width, region.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, style.padded ? ImGui::GetStyle().WindowPadding : ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav |
                     (style.background ? 0 : ImGuiWindowFlags_NoBackground));
    ImGui::PopStyleVar(2);
}

void end_region() { ImGui::End(); }

void drag_splitters(UiState& ui, const Layout& layout, float window_width) {
    Splitters& s = ui.settings.splitters;
    const float em = ImGui::GetFontSize(), mouse = ImGui::GetIO().MousePos.x;
    bool reset = false;
    if (draw_splitter(ui, "outliner", layout.viewport.x, layout.viewport, reset)) s = drag_outliner(s, mouse, em);
    if (reset) s.outliner = Splitters{}.outliner;
    if (draw_splitter(ui, "inspector", layout.inspector.x, layout.viewport, reset)) s = drag_inspector(s, mouse, window_width, em);
    if (reset) s.inspector = Splitters{}.inspector;
}

} // namespace blush
