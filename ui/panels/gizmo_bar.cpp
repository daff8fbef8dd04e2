// Toolbar at the left of the image that selects the gizmo and its axes; visible while something is selected.
#include "ui/gl/icons.h"
#include "ui/panels/panels.h"
#include "ui/widgets/tooltip.h"
#include "ui/window/theme.h"

#include <fmt/format.h>

namespace blush {
namespace {

constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize;

bool button(PanelContext& c, const char* name, Icon icon, bool chosen, const std::string& tip) {
    const bool pressed = icon_button(name, icon, chosen ? tone::accent : tone::text);
    c.ui.probe.record_last_item(std::string("Gizmo/") + name);
    tip_for_last_item(c.ui, tip.c_str());
    return pressed;
}

} // namespace

void draw_gizmo_bar(PanelContext& c, const Region& image) {
    if (!c.ui.settings.overlays || c.ui.transform.active || !c.scene().nodes.contains(c.ui.selected)) return;
    const float em = ImGui::GetFontSize();
    if (image.height < em * 19) return; // it would cover the environment dial; keys do the same
    ImGui::SetNextWindowPos({std::max(image.x, 0.f) + em * 0.5f, image.y + image.height / 2}, ImGuiCond_Always, {0, 0.5f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, em / 4);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em * 0.2f, em * 0.2f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::SetNextWindowBgAlpha(0.6f);
    if (ImGui::Begin("##gizmos", nullptr, flags)) {
        TransformView& view = c.ui.transform;
        const auto choose = [&](TransformMode mode, const char* name, Icon icon, Command key) {
            const std::string tip =
                fmt::format("Gizmo to {} the selection. {} does it with the mouse alone; {} switches to the next gizmo.", name,
                            keys_of(shortcut(key)), keys_of(shortcut(Command::next_gizmo)));
            if (button(c, name, icon, view.gizmo == mode, tip)) view.gizmo = mode;
        };
        choose(TransformMode::grab, "move", Icon::move, Command::grab);
        choose(TransformMode::rotate, "rotate", Icon::rotate, Command::rotate);
        choose(TransformMode::scale, "scale", Icon::scale, Command::scale);
        const std::string tip = fmt::format("{} axes. {} switches between world axes and the local axes of the selection.",
                                            view.local ? "Local" : "World", keys_of(shortcut(Command::local_axes)));
        if (button(c, "axes", view.local ? Icon::local_axes : Icon::world_axes, false, tip)) view.local = !view.local;
    }
    ImGui::End();
    ImGui::PopStyleVar(3);
}

} // namespace blush
