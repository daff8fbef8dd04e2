#include "ui/regions.h"

#include "ui/theme.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <epoxy/gl.h>
#include <imgui.h>

namespace blush {
namespace {

// Clears a rectangle to an opaque colour. A software rasteriser fills one through ImGui's shader, texture and blending in four times as
// long.
void clear_to(ImDrawList& draw, const Region& region, ImU32 color) {
    draw.PushClipRect({region.x, region.y}, {region.x + region.width, region.y + region.height});
    draw.AddCallback(
        [](const ImDrawList*, const ImDrawCmd* command) {
            const ImVec4 rgba = ImGui::ColorConvertU32ToFloat4(ImU32(reinterpret_cast<uintptr_t>(command->UserCallbackData))),
                         clip = command->ClipRect;
            const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
            const float height = ImGui::GetIO().DisplaySize.y;
            const auto pixel = [](float at) { return GLint(std::lround(at)); };
            glScissor(pixel(clip.x * scale.x), pixel((height - clip.w) * scale.y), std::max(pixel((clip.z - clip.x) * scale.x), 0),
                      std::max(pixel((clip.w - clip.y) * scale.y), 0));
            glClearColor(rgba.x, rgba.y, rgba.z, 1);
            glClear(GL_COLOR_BUFFER_BIT);
        },
        reinterpret_cast<void*>(uintptr_t(color)));
    draw.PopClipRect();
}

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
                     ImGuiWindowFlags_NoBackground);
    ImGui::PopStyleVar(2);
    if (style.background) clear_to(*ImGui::GetWindowDrawList(), region, ImGui::GetColorU32(ImGuiCol_WindowBg));
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
