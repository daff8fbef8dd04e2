// Banner for scenes without lights: says that the scene is shown in a studio, and offers other lighting. Also shown if the last
// light is removed.
#include "ui/panels/panels.h"
#include "ui/widgets/tooltip.h"
#include "ui/window/theme.h"

#include <initializer_list>

namespace blush {
namespace {

constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize;

void draw_button(PanelContext& c, const char* name, std::initializer_list<Command> commands, const char* tip) {
    ImGui::SameLine();
    if (ImGui::Button(name)) {
        c.ui.studio_banner = false;
        c.ui.commands.insert(c.ui.commands.end(), commands);
    }
    c.ui.probe.record_last_item(std::string("No light/") + name);
    tip_for_last_item(c.ui, tip);
}

constexpr const char* sky_tip = "Add a clear sky with sun.";
constexpr const char* environment_tip = "Choose a panorama image (.hdr, .exr) as the environment.";
constexpr const char* add_light_tip = "Add a rectangle light beside the subject.";

void draw_choices(PanelContext& c) {
    ImGui::TextUnformatted("No light in this file");
    draw_button(c, "Studio", {Command::light_by_studio}, "Add three softboxes and a studio panorama.");
    draw_button(c, "Sky", {Command::light_by_sky}, sky_tip);
    draw_button(c, "Environment...", {Command::environment}, environment_tip);
    draw_button(c, "Add light", {Command::add_rectangle}, add_light_tip);
}

// Other lighting replaces the studio: the step that added it is undone first.
void draw_choices_in_studio(PanelContext& c) {
    ImGui::TextUnformatted("No light in this file: shown in a studio");
    draw_button(c, "Keep", {}, "Keep the three softboxes and the panorama as lights of the scene. They are saved with it.");
    draw_button(c, "Sky", {Command::undo, Command::light_by_sky}, sky_tip);
    draw_button(c, "Environment...", {Command::undo, Command::environment}, environment_tip);
    draw_button(c, "Add light", {Command::undo, Command::add_rectangle}, add_light_tip);
    draw_button(c, "No light", {Command::undo}, "Remove the studio lighting. The scene is black, as in the file.");
}

} // namespace

void draw_no_light_banner(PanelContext& c, const Region& viewport) {
    if (c.scene().nodes.empty()) return;
    // The first edit also keeps the studio.
    if (c.ui.studio_banner && (c.document.undo_labels().size() != 1 || c.document.can_redo())) c.ui.studio_banner = false;
    const bool dark = !c.ui.light_presence.in(c.scene());
    if (!dark && !c.ui.studio_banner) return;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({viewport.x + viewport.width / 2, viewport.y + em}, ImGuiCond_Always, {0.5f, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, em / 4);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em, em * 0.7f});
    ImGui::SetNextWindowBgAlpha(0.92f);
    if (ImGui::Begin(dark ? "##no light" : "##no light in the file", nullptr, flags)) {
        ImGui::AlignTextToFramePadding();
        dark ? draw_choices(c) : draw_choices_in_studio(c);
        c.ui.probe.record("No light",
                          {ImGui::GetWindowPos().x, ImGui::GetWindowPos().y, ImGui::GetWindowWidth(), ImGui::GetWindowHeight()});
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
}

} // namespace blush
