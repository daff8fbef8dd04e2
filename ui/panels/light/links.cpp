// Light linking: which objects a light illuminates, and which cast its shadows.
#include "render/lights/light_links.h"
#include "scene/node_name.h"
#include "ui/lights/multi_edit_apply.h"
#include "ui/panels/panels.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui.h>
#include <set>
#include <unordered_set>

namespace blush {
namespace {

std::string name_of(const Scene& scene, Id<Node> id) {
    const Node* node = scene.nodes.find(id);
    return node ? node_name(scene, id, *node) : "deleted object";
}

// Nodes with triangles in their subtree that are not in the set. Names used more than once get the node's number.
struct Candidates {
    std::vector<Id<Node>> nodes;
    std::vector<std::string> names;
};
Candidates candidates(const Scene& scene, const ObjectSet& set) {
    std::set<Id<Node>> solid;
    for (const auto& [id, node] : scene.nodes) {
        if (!node.mesh) continue;
        for (Id<Node> up = id; scene.nodes.contains(up) && solid.insert(up).second;) up = scene.nodes.find(up)->parent;
    }
    Candidates found;
    std::unordered_set<std::string> taken; // a set, because this runs in every frame for all objects of the scene
    for (const Id<Node> id : solid) {
        if (std::ranges::count(set.nodes, id)) continue;
        std::string name = name_of(scene, id);
        if (!taken.insert(name).second) name += fmt::format(" ({})", id.value);
        found.nodes.push_back(id);
        found.names.push_back(std::move(name));
    }
    return found;
}

// One row per node of the set ("all but" or "only"), each with a button that removes it.
bool draw_set(PanelContext& c, const char* label, ObjectSet& set, const char* tip) {
    const std::string scope = std::string("Linking/") + label;
    Fields f(c.ui, scope.c_str());
    const char* const choices[] = {set.nodes.empty() ? "Everything" : "All but", "Only"};
    int choice = set.all_but ? 0 : 1;
    if (f.choice(label, choice, choices, tip)) set.all_but = choice == 0;
    if (!set.all_but && set.nodes.empty()) f.info("", "no objects yet");
    for (size_t i = 0; i < set.nodes.size(); ++i) {
        if (!f.removable(name_of(c.scene(), set.nodes[i]))) continue;
        set.nodes.erase(set.nodes.begin() + std::ptrdiff_t(i));
        break;
    }
    const Candidates others = candidates(c.scene(), set);
    std::vector<const char*> names;
    for (const std::string& name : others.names) names.push_back(name.c_str());
    int added = -1;
    if (f.choice(set.all_but ? "Leave out" : "Add", added, names, "An object includes all its children."))
        set.nodes.push_back(others.nodes[size_t(added)]);
    return f.changed();
}

// Warns if the renderer cannot use this light's shadow linking.
void draw_limit(PanelContext& c, const Light& light) {
    const CasterSets sets(c.scene());
    if (!leaves_out(light.shadow_casters, c.scene()) || sets.left_out() == 0) return;
    const bool left_out = sets.ray_mask(c.scene(), light) == CasterSets().ray_mask(c.scene(), light);
    ImGui::PushStyleColor(ImGuiCol_Text, tone::warning);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(
        fmt::format("More than {} different sets of shadow casters. Shadow linking is ignored for {}: all objects cast shadows.",
                    max_caster_sets, left_out ? "this light" : fmt::format("{} other lights", sets.left_out()))
            .c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    c.ui.probe.record_last_item(left_out ? "Linking/Left out" : "Linking/Others left out");
}

} // namespace

void draw_light_links_panel(PanelContext& c, Id<Node> id) {
    const Node* node = c.scene().nodes.find(id);
    const Light* record = node ? c.scene().lights.find(node->light) : nullptr;
    if (!record) return;
    // Opens when the first link is made, and stays open when the last one is removed.
    if (leaves_out(record->lit_objects, c.scene()) || leaves_out(record->shadow_casters, c.scene()))
        c.ui.settings.panels.try_emplace("section.Linking", 1);
    if (!section(c.ui, "Linking", false)) return;
    const Id<Light> light_id = node->light;
    Light light = *record;
    bool changed = draw_set(c, "Lights", light.lit_objects,
                            "Objects that this light illuminates. Shift+click an object in the image to remove or add it.");
    changed |=
        draw_set(c, "Shadows of", light.shadow_casters,
                 "Objects that cast shadows of this light. Other objects let its light through. Alt+Shift+click an object in the image "
                 "to remove or add it.");
    draw_limit(c, *record);
    if (changed) set_light(c, light_id, light, no_gesture);
}

} // namespace blush
