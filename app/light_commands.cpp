#include "app/light_commands.h"

#include "ui/edit_together.h"
#include "ui/light_groups.h"
#include "ui/light_view.h"

#include <algorithm>

namespace blush {
namespace {

std::vector<Id<Light>> selected_lights(PanelContext& c) {
    std::vector<Id<Light>> lights = lights_of(c.scene(), c.ui.selection(c.scene()));
    if (lights.empty()) c.ui.toasts.note("No light is selected");
    return lights;
}

const Light* light_of(PanelContext& c, Id<Node> id) {
    const Node* node = c.scene().nodes.find(id);
    return node ? c.scene().lights.find(node->light) : nullptr;
}

} // namespace

void toggle_mute(PanelContext& c) {
    const auto lights = selected_lights(c);
    const bool some_on = std::ranges::any_of(lights, [&](Id<Light> id) { return c.scene().lights.find(id)->enabled; });
    c.apply(change_lights(c.scene(), lights, [&](Light& light) { light.enabled = !some_on; }),
            label_for(some_on ? "Mute" : "Unmute", c.scene(), lights));
}

void toggle_solo(PanelContext& c) {
    const auto lights = selected_lights(c);
    const bool all_solo = std::ranges::all_of(lights, [&](Id<Light> id) { return c.scene().lights.find(id)->solo; });
    c.apply(change_lights(c.scene(), lights, [&](Light& light) { light.solo = !all_solo; }),
            label_for(all_solo ? "End solo of" : "Solo", c.scene(), lights));
}

void group_lights(PanelContext& c) {
    const auto lights = selected_lights(c);
    const std::string group = unused_group_name(c.scene());
    c.apply(change_lights(c.scene(), lights, [&](Light& light) { light.group = group; }), label_for("Group", c.scene(), lights));
}

void toggle_placing(PanelContext& c, PlacingBy by) {
    if (!light_of(c, c.ui.selected)) return c.ui.toasts.note("Select the light to place first");
    c.ui.placing_by = c.ui.placing_by == by ? PlacingBy::hand : by;
    c.ui.tool = ViewTool::none;
}

void toggle_look_through(PanelContext& c) {
    if (c.ui.looked_through) {
        c.document.navigate(c.ui.looked_through->back);
        return c.ui.looked_through.reset();
    }
    const Id<Node> id = c.ui.selected;
    const Light* light = light_of(c, id);
    if (!light) return c.ui.toasts.note("Select the light to look through first");
    c.ui.looked_through = LookedThrough{id, c.scene().view};
    c.ui.placing_by = PlacingBy::hand;
    c.document.navigate(first_view_through_light(c.scene().view, *light, pose_of(c.scene(), id), clearance(c.scene(), id)));
}

} // namespace blush
