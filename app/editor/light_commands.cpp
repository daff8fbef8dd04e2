#include "app/editor/light_commands.h"

#include "app/common/scene_overrides.h"
#include "ui/lights/light_camera.h"
#include "ui/lights/light_groups.h"
#include "ui/lights/light_rows.h"
#include "ui/lights/multi_edit.h"
#include "ui/panels/instruments.h"

#include <algorithm>
#include <iterator>

namespace blush {
namespace {

bool has_material(const Scene& scene, Id<Node> id, Id<Material> material) {
    const Mesh* mesh = scene.meshes.find(scene.nodes.find(id)->mesh);
    return mesh && std::ranges::count(mesh->parts, material, &MeshPart::material) > 0;
}

// Lights, emissive materials, or the environment.
std::vector<LightRow> selected_rows(PanelContext& c) {
    const std::vector<Id<Node>> nodes = c.ui.selection(c.scene());
    const std::vector<Id<Light>> lights = lights_of(c.scene(), nodes);
    const auto selected = [&](const LightRow& row) {
        if (row.light) return std::ranges::count(lights, row.light) > 0;
        if (row.environment) return c.ui.environment_chosen();
        return std::ranges::any_of(nodes, [&](Id<Node> id) { return has_material(c.scene(), id, row.material); });
    };
    std::vector<LightRow> rows;
    for (const LightRows& group : light_rows(c.scene())) std::ranges::copy_if(group.rows, std::back_inserter(rows), selected);
    if (rows.empty()) c.ui.toasts.note("No light or emissive object is selected");
    return rows;
}

template <class Switch>
void switch_rows(PanelContext& c, const std::vector<LightRow>& rows, const std::string& what, const Switch& switched) {
    std::vector<Edit> edits;
    for (const LightRow& row : rows) edits.push_back(switched(row));
    const std::string which = rows.size() == 1 ? rows[0].name : std::to_string(rows.size()) + " lights";
    if (!edits.empty()) c.apply(edits, what + " " + which);
}

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

void add_light_rig(PanelContext& c, LightRig rig) {
    const Environment studio = rig == LightRig::studio ? studio_map() : Environment{};
    if (c.apply(light_rig_edits(c.scene(), rig, studio), rig == LightRig::studio ? "Studio lighting" : "Sky lighting"))
        c.ui.meter_exposure = true;
}

void toggle_mute(PanelContext& c) {
    const auto rows = selected_rows(c);
    const bool some_on = std::ranges::any_of(rows, &LightRow::on);
    switch_rows(c, rows, some_on ? "Mute" : "Unmute",
                [&](const LightRow& row) { return with_switches(c.scene(), row, !some_on, row.solo); });
}

void toggle_solo(PanelContext& c) {
    const auto rows = selected_rows(c);
    const bool all_solo = std::ranges::all_of(rows, &LightRow::solo);
    switch_rows(c, rows, all_solo ? "End solo of" : "Solo",
                [&](const LightRow& row) { return with_switches(c.scene(), row, row.on, !all_solo); });
}

void group_lights(PanelContext& c) {
    const auto lights = selected_lights(c);
    const std::string group = unused_group_name(c.scene());
    c.apply(change_lights(c.scene(), lights, [&](Light& light) { light.group = group; }),
            label_for("Group", c.scene(), lights, c.ui.selection(c.scene())));
}

void toggle_light_mix(PanelContext& c) {
    toggle_instrument(c, "light_mix");
    LightMix mix = c.scene().mix;
    if (!c.ui.light_mix.open || c.ui.light_mix.disabled_by_user || mix.grouping != LightMix::Grouping::none) return;
    mix.grouping = LightMix::Grouping::by_light;
    const Edit edit = SetMix{mix};
    c.apply({&edit, 1}, "Group lights for the mix");
}

void toggle_placing(PanelContext& c, PlacingBy by) {
    if (!light_of(c, c.ui.selected)) return c.ui.toasts.note("Select the light to place first");
    c.ui.placing_by = c.ui.placing_by == by ? PlacingBy::hand : by;
    c.ui.tool = ViewTool::none;
}

void toggle_look_through(PanelContext& c) {
    if (c.ui.light_camera) {
        c.document.navigate(c.ui.light_camera->back);
        return c.ui.light_camera.reset();
    }
    const Id<Node> id = c.ui.selected;
    const Light* light = light_of(c, id);
    if (!light) return c.ui.toasts.note("Select the light to look through first");
    c.ui.light_camera = LookedThrough{id, c.scene().view};
    c.ui.placing_by = PlacingBy::hand;
    c.document.navigate(initial_light_view(c.scene().view, *light, pose_of(c.scene(), id), clearance(c.scene(), id)));
}

} // namespace blush
