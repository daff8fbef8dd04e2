#include "ui/lights/multi_edit_apply.h"

#include "render/lights/light_links.h"
#include "scene/node_name.h"
#include "ui/lights/multi_edit.h"

#include <algorithm>

namespace blush {

bool set_light(PanelContext& c, Id<Light> id, const Light& after, Gesture gesture) {
    const Light* record = c.scene().lights.find(id);
    if (!record) return false; // its creation was undone during the drag
    const Light before = *record;
    const std::vector<Id<Node>> selection = c.ui.selection(c.scene());
    std::vector<Id<Light>> lights = lights_of(c.scene(), selection);
    if (!std::ranges::count(lights, id)) lights = {id};
    std::vector<Edit> edits{SetLight{id, after}};
    std::erase(lights, id);
    for (Edit& edit : change_lights(c.scene(), lights, [&](Light& light) { light = apply_same_edit(light, before, after); }))
        edits.push_back(std::move(edit));
    lights.push_back(id);
    return c.apply(edits, label_for("Change", c.scene(), lights, selection), gesture);
}

bool toggle_link(PanelContext& c, Id<Node> object, ObjectSet Light::*set) {
    const Node *node = c.scene().nodes.find(c.ui.selected), *other = c.scene().nodes.find(object);
    const Light* record = node ? c.scene().lights.find(node->light) : nullptr;
    if (!record || !other || other->light) return false;
    const std::string name = node_name(c.scene(), object, *other), of = node_name(c.scene(), c.ui.selected, *node);
    Light light = *record;
    toggle(light.*set, c.scene(), object);
    if (!set_light(c, node->light, light, no_gesture)) return true;
    const bool in = contains(light.*set, c.scene(), object);
    if (set == &Light::lit_objects)
        c.ui.toasts.note(name + (in ? " is lit by " : " is no longer lit by ") + of);
    else
        c.ui.toasts.note(name + (in ? " casts shadows of " : " casts no shadows of ") + of);
    return true;
}

std::string about_selected_lights(const PanelContext& c) {
    const std::vector<Id<Light>> lights = lights_of(c.scene(), c.ui.selection(c.scene()));
    if (lights.size() < 2) return {};
    std::string text = std::to_string(lights.size()) + " lights are edited together: edits apply to all of them, intensities are scaled by "
                                                       "the same factor.";
    const std::vector<std::string> fields = differing_fields(c.scene(), lights);
    for (size_t i = 0; i < fields.size(); ++i) text += (i == 0 ? " They differ in " : i + 1 < fields.size() ? ", " : " and ") + fields[i];
    return fields.empty() ? text : text + ".";
}

} // namespace blush
