// The shortcut sheet (F1): all commands with a key, and the mouse controls.
#include "ui/panels/panels.h"
#include "ui/widgets/guide_mark.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>

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

// One column: the commands of some groups that have a key. Keys are aligned behind the longest name.
void draw_groups(PanelContext& c, std::initializer_list<const char*> groups) {
    const auto in = [](const Shortcut& s, const char* group) { return std::strcmp(s.group, group) == 0 && s.press.key != key::none; };
    float longest_name = 0;
    for (const Shortcut& s : shortcuts())
        for (const char* group : groups)
            if (in(s, group)) longest_name = std::max(longest_name, ImGui::CalcTextSize(s.name).x);
    for (const char* group : groups) {
        heading(group);
        for (const Shortcut& s : shortcuts())
            if (in(s, group)) {
                line(s.name, keys_of(s).c_str(), longest_name + ImGui::GetFontSize());
                c.ui.probe.record_last_item(std::string("Shortcut/") + s.group + "/" + s.name);
            }
    }
}

void draw_mouse() {
    float longest_name = 0;
    for (const MouseHint& hint : mouse_hints()) longest_name = std::max(longest_name, ImGui::CalcTextSize(hint.action).x);
    heading("Mouse");
    for (const MouseHint& hint : mouse_hints()) line(hint.action, hint.gesture, longest_name + ImGui::GetFontSize());
}

} // namespace

void draw_shortcut_sheet(PanelContext& c) {
    if (!c.ui.show_shortcuts) return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {screen.x * 0.95f, screen.y}); // all of it in a window of 1280x720
    if (ImGui::Begin("Shortcuts", &c.ui.show_shortcuts,
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_HorizontalScrollbar |
                         ImGuiWindowFlags_NoSavedSettings)) {
        guide_mark_in_title_bar(c.ui, "Guide/Shortcuts", guide_page::first_steps);
        ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {ImGui::GetFontSize(), 0});
        if (ImGui::BeginTable("columns", screen.x > 80 * ImGui::GetFontSize() ? 3 : 1, ImGuiTableFlags_SizingFixedFit)) {
            ImGui::TableNextColumn();
            draw_groups(c, {"File", "Edit", "Add light", "Help"});
            ImGui::TableNextColumn();
            draw_groups(c, {"Look", "View"});
            ImGui::TableNextColumn();
            draw_mouse();
            draw_groups(c, {"Lights"});
            ImGui::EndTable();
        }
        ImGui::PopStyleVar();
        ImGui::Spacing();
    }
    ImGui::End();
}

} // namespace blush
