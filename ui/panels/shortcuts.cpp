// The shortcut sheet (F1): the table of commands, and what the mouse does.
#include "ui/panels/panels.h"
#include "ui/theme.h"

#include <cstring>

namespace blush {
namespace {

void heading(const char* text) {
    ImGui::Spacing();
    ImGui::PushFont(heading_font());
    ImGui::TextUnformatted(text);
    ImGui::PopFont();
}

void line(const char* what, const char* how, float column) {
    ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
    ImGui::TextUnformatted(what);
    ImGui::PopStyleColor();
    ImGui::SameLine(column);
    ImGui::TextUnformatted(how);
}

// The commands of one group that have a key.
void draw_group(const char* group, float column) {
    heading(group);
    for (const Shortcut& s : shortcuts()) {
        if (std::strcmp(s.group, group) != 0 || s.press.key == key::none) continue;
        line(s.name, keys_of(s).c_str(), column);
    }
}

} // namespace

void draw_shortcut_sheet(PanelContext& c) {
    if (!c.ui.show_shortcuts) return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(em * 80, screen.x * 0.95f), 0});
    if (ImGui::Begin("Shortcuts", &c.ui.show_shortcuts,
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings)) {
        const float width = ImGui::GetContentRegionAvail().x;
        if (ImGui::BeginTable("columns", 3)) {
            ImGui::TableSetupColumn("files", ImGuiTableColumnFlags_WidthStretch, 0.3f);
            ImGui::TableSetupColumn("lights", ImGuiTableColumnFlags_WidthStretch, 0.26f);
            ImGui::TableSetupColumn("mouse", ImGuiTableColumnFlags_WidthStretch, 0.44f);
            ImGui::TableNextColumn();
            for (const char* group : {"File", "Edit", "View"}) draw_group(group, width * 0.15f);
            ImGui::TableNextColumn();
            for (const char* group : {"Add light", "Lights", "Look", "Help"}) draw_group(group, width * 0.15f);
            ImGui::TableNextColumn();
            heading("Mouse");
            for (const MouseHint& hint : mouse_hints()) line(hint.action, hint.gesture, width * 0.17f);
            ImGui::EndTable();
        }
        ImGui::Spacing();
    }
    ImGui::End();
}

} // namespace blush
