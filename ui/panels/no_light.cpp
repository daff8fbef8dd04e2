// What a scene without any light offers in place of a black picture: ways to light it, each one edit.
#include "ui/panels/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace blush {
namespace {

constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize;

void draw_button(PanelContext& c, const char* name, Command command, const char* tip) {
    ImGui::SameLine();
    if (ImGui::Button(name)) c.ui.commands.push_back(command);
    c.ui.probe.record_last_item(std::string("No light/") + name);
    tip_for_last_item(c.ui, tip);
}

} // namespace

void draw_no_light_banner(PanelContext& c, const Region& picture) {
    if (c.scene().nodes.empty() || c.ui.light_presence.in(c.scene())) return;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({picture.x + picture.width / 2, picture.y + picture.height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, em / 4);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em, em * 0.7f});
    ImGui::SetNextWindowBgAlpha(0.92f);
    if (ImGui::Begin("##no light", nullptr, flags)) {
        if (ImGui::IsWindowAppearing()) c.ui.next_frame_in = 0; // it is seen in the frame after the one that measures it
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted("No light in this file");
        draw_button(c, "Studio", Command::light_by_studio, "Three softboxes and the panorama of a studio light the scene.");
        draw_button(c, "Sky", Command::light_by_sky, "A clear sky with its sun lights the scene.");
        draw_button(c, "Environment...", Command::environment, "A panorama (.hdr, .exr) lights the scene as the place where it was taken.");
        draw_button(c, "Add light", Command::add_rectangle, "A rectangle light beside the subject.");
        c.ui.probe.record("No light", {ImGui::GetWindowPos().x, ImGui::GetWindowPos().y, ImGui::GetWindowWidth(), ImGui::GetWindowHeight()});
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
}

} // namespace blush
