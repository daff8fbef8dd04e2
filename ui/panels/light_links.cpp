// Linking: which objects the light lights, and which cast its shadows.
#include "render/light_links.h"
#include "ui/light_tools.h"
#include "ui/panels/panels.h"
#include "ui/widgets.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui.h>

namespace blush {
namespace {

constexpr const char* choices[] = {"Everything", "All but", "Only"};

std::string name_of(const Scene& scene, Id<Node> id) {
    const Node* node = scene.nodes.find(id);
    if (!node) return "an object that is gone";
    return node->name.empty() ? fmt::format("Node {}", id.value) : node->name;
}

int choice_of(const ObjectSet& set) { return !set.all_but ? 2 : set.nodes.empty() ? 0 : 1; }

// One row for each object of the set, and a menu of those that could be.
bool draw_objects(PanelContext& c, const std::string& scope, ObjectSet& set) {
    bool changed = false;
    for (size_t i = 0; i < set.nodes.size(); ++i) {
        const std::string name = name_of(c.scene(), set.nodes[i]);
        ImGui::PushID(int(i));
        if (ImGui::SmallButton("x")) {
            set.nodes.erase(set.nodes.begin() + std::ptrdiff_t(i));
            changed = true;
        }
        c.ui.probe.record_last_item(scope + "/Remove " + name);
        ImGui::SameLine();
        ImGui::TextUnformatted(name.c_str());
        ImGui::PopID();
        if (changed) break;
    }
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (ImGui::BeginCombo("##add", "Add an object")) {
        for (const auto& [id, node] : c.scene().nodes) {
            if (!node.mesh || std::ranges::find(set.nodes, id) != set.nodes.end()) continue;
            ImGui::PushID(int(id.value));
            if (ImGui::Selectable(name_of(c.scene(), id).c_str())) {
                set.nodes.push_back(id);
                changed = true;
            }
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
    c.ui.probe.record_last_item(scope + "/Add");
    return changed;
}

bool draw_set(PanelContext& c, const char* label, ObjectSet& set, const char* tip) {
    ImGui::PushID(label);
    Fields f(c.ui, "Linking");
    int choice = choice_of(set);
    bool changed = f.choice(label, choice, choices, tip);
    if (changed) {
        set.all_but = choice != 2;
        if (choice == 0) set.nodes.clear();
    }
    // Of everything, the first object that is added is the first that is left out.
    changed |= draw_objects(c, std::string("Linking/") + label, set);
    ImGui::PopID();
    return changed;
}

} // namespace

void draw_light_links_panel(PanelContext& c, Id<Node> id) {
    const Node* node = c.scene().nodes.find(id);
    const Light* record = node ? c.scene().lights.find(node->light) : nullptr;
    if (!record || !section(c.ui, "Linking", false)) return;
    const Id<Light> light_id = node->light;
    Light light = *record;
    bool changed = draw_set(c, "Lights", light.lit_objects,
                            "What this light lights. An object stands for all that hangs below it. Shift+click on an object in the picture "
                            "takes it out, or in again.");
    changed |= draw_set(c, "Shadows of", light.shadow_casters, "What stands in the way of this light. The rest lets its light through.");
    if (const int left_out = CasterSets(c.scene()).left_out(); left_out > 0)
        quiet_text(fmt::format("There are more than {} different sets of shadow casters: everything casts the shadows of {} lights.",
                               most_caster_sets, left_out));
    if (changed) c.apply(SetLight{light_id, light});
}

} // namespace blush
