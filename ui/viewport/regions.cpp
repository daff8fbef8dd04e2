#include "ui/viewport/regions.h"

#include "ui/window/theme.h"

#include <imgui.h>

namespace blush {
namespace {

// A splitter: `edge` has zero width (it is dragged horizontally) or zero height. True while it is dragged.
bool draw_splitter(UiState& ui, const char* id, const Region& edge, bool& reset) {
    const bool upright = edge.width <= 0;
    const float grab = std::max(6.f, ImGui::GetFontSize() * 0.5f);
    const Region bar = upright ? Region{edge.x - grab / 2, edge.y, grab, edge.height} : Region{edge.x, edge.y - grab / 2, edge.width, grab};
    ImGui::SetNextWindowPos({bar.x, bar.y});
    ImGui::SetNextWindowSize({bar.width, bar.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::Begin(id, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBackground |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::InvisibleButton("bar", {bar.width, bar.height});
    ui.probe.record_last_item(std::string("Splitter/") + id);
    const bool active = ImGui::IsItemActive();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    if (active || ImGui::IsItemHovered()) {
        ImGui::SetMouseCursor(upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
        const float half_x = upright ? 1.f : 0.f, half_y = upright ? 0.f : 1.f;
        draw.AddRectFilled({edge.x - half_x, edge.y - half_y}, {edge.x + edge.width + half_x, edge.y + edge.height + half_y},
                           active ? tone::text : tone::dim_text);
    } else {
        draw.AddLine({edge.x, edge.y}, {edge.x + edge.width, edge.y + edge.height}, tone::line);
    }
    reset = ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    ImGui::End();
    ImGui::PopStyleVar(2);
    return active;
}

Region left_edge(const Region& r) { return {r.x, r.y, 0, r.height}; }
Region upper_edge(const Region& r) { return {r.x, r.y, r.width, 0}; }

void drag_dock_splitters(UiState& ui, const Layout& l) {
    DockSizes& sizes = ui.settings.dock.sizes;
    const float em = ImGui::GetFontSize();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    bool reset = false;
    // Outside the window if there is no dock: see drag_splitters.
    constexpr Region beside{-99, -99, 0, 1}, above{-99, -99, 1, 0};
    if (draw_splitter(ui, "right dock", l.right_dock.width > 0 ? left_edge(l.right_dock) : beside, reset))
        sizes = drag_right_dock(sizes, mouse.x, l, em);
    if (reset) sizes.right = DockSizes{}.right;
    if (draw_splitter(ui, "bottom dock", l.bottom_dock.height > 0 ? upper_edge(l.bottom_dock) : above, reset))
        sizes = drag_bottom_dock(sizes, mouse.y, l, em);
    if (reset) sizes.bottom = DockSizes{}.bottom;
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
    if (draw_splitter(ui, "outliner", {layout.outliner.width, layout.outliner.y, 0, layout.outliner.height}, reset))
        s = drag_outliner(s, mouse, em);
    if (reset) s.outliner = Splitters{}.outliner;
    if (draw_splitter(ui, "inspector", left_edge(layout.inspector), reset)) s = drag_inspector(s, mouse, window_width, em);
    if (reset) s.inspector = Splitters{}.inspector;
    drag_dock_splitters(ui, layout);
}

} // namespace blush
