// Object and Transform sections: name, visibility, transform and mesh of the selected node.
#include "scene/animation/pose.h"
#include "ui/panels/panels.h"
#include "ui/transform/rotation.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

int64_t triangle_count(const Mesh& mesh) {
    int64_t count = 0;
    for (const MeshPart& part : mesh.parts) count += part.geometry ? int64_t(part.geometry->triangle_count()) : 0;
    return count;
}

std::string grouped(int64_t number) {
    const std::string digits = std::to_string(number);
    std::string text;
    for (size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) text += ' ';
        text += digits[i];
    }
    return text;
}

// Euler angles of the rotation. Angles typed by the user stay as long as only this panel rotates the node.
Vec3d& angles_of(EulerFields& fields, Id<Node> id, const Quat& rotation) {
    if (fields.node != id || fields.rotation != rotation) {
        const Vec3d e = euler_degrees(rotation);
        const auto tidy = [](double degrees) { return std::round(degrees * 1e4) / 1e4 + 0.0; }; // no -0
        fields = {id, rotation, {tidy(e.x), tidy(e.y), tidy(e.z)}};
    }
    return fields.degrees;
}

// Emission that is visible at this exposure: twice the luminance shown as white.
void draw_make_light(PanelContext& c, Id<Node> id) {
    const float nits = 2 * std::exp2(-c.project().view.exposure_ev);
    if (ImGui::Button("Make it a light", {-FLT_MIN, 0}) && c.apply(MakeEmissive{id, nits})) {
        const Mesh* mesh = c.scene().meshes.find(c.scene().nodes.find(id)->mesh);
        c.ui.selected_material = mesh->parts.empty() ? Id<Material>{} : mesh->parts.front().material;
    }
    c.ui.probe.record_last_item("Object/Make it a light");
    tip_for_last_item(c.ui, "Give the object its own emissive material. Set its strength under Emission.");
}

} // namespace

void draw_object_panel(PanelContext& c, Id<Node> id) {
    const Node* record = c.scene().nodes.find(id);
    if (!record) return;
    Node node = *record;
    Fields f(c.ui, "Object");
    f.text("Name", node.name, "Name in the outliner, the history and saved files.");
    f.checkbox("Visible", node.visible, "If off, the node and its children are invisible, cast no shadows and emit no light.");
    f.checkbox("Shadow catcher", node.shadow_catcher,
               "The camera sees only the shadows on it, in the image's alpha. Reflections and indirect light treat it as a normal "
               "object. Includes all children.");
    if (const Mesh* mesh = c.scene().meshes.find(node.mesh)) {
        f.info("Mesh", fmt::format("{} triangles{}", grouped(triangle_count(*mesh)),
                                   mesh->parts.size() > 1 ? fmt::format(", {} parts", mesh->parts.size()) : ""));
        if (node.instances) f.info("Copies", grouped(int64_t(node.instances->node_from_copy.size())));
    }
    if (f.changed()) c.apply(SetNode{id, node}, f.gesture());

    const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    if (ImGui::Button("Duplicate", {half, 0})) c.ui.commands.push_back(Command::duplicate);
    c.ui.probe.record_last_item("Object/Duplicate");
    ImGui::SameLine();
    if (ImGui::Button("Delete", {half, 0})) c.ui.commands.push_back(Command::remove);
    c.ui.probe.record_last_item("Object/Delete");
    if (c.scene().meshes.contains(node.mesh)) draw_make_light(c, id);
}

void draw_transform_panel(PanelContext& c, Id<Node> id) {
    const Node* record = c.scene().nodes.find(id);
    if (!record || !section(c.ui, "Transform")) return;
    Node node = *record;
    node.local = posed_transform(c.scene(), id, node);
    const bool led = is_transform_animated(c.scene(), id);
    if (led) quiet_text("Animated. Select the rest pose in the timeline to edit the transform.");
    if (node.skin) quiet_text("Skinned: joints define its position. The node's own transform has no effect.");
    ImGui::BeginDisabled(led);
    Fields f(c.ui, "Transform");
    if (node.local.matrix) {
        quiet_text("This transform is a sheared matrix. Position, rotation and scale cannot represent shear: editing rotation or scale "
                   "removes it.");
    }
    if (f.vector("Position", node.local.translation, {0, 0, 0},
                 {.unit = "", .step = 0.005f, .tip = "Metres, relative to the parent node."}) &&
        node.local.matrix) {
        node.local.matrix->t = node.local.translation;
    }
    Vec3d& degrees = angles_of(c.ui.euler, id, node.local.rotation);
    Vec3 angles = to_float(degrees);
    if (f.vector("Rotation", angles, {0, 0, 0},
                 {.unit = "°", .step = 0.25f, .tip = "Degrees about the parent's X, then Y, then Z axis.", .format = "%.1f"})) {
        degrees = to_double(angles);
        node.local.rotation = c.ui.euler.rotation = from_euler_degrees(degrees);
        node.local.matrix.reset();
    }
    if (f.vector("Scale", node.local.scale, {1, 1, 1}, {.step = 0.005f, .tip = "Factors along the node's own axes."}))
        node.local.matrix.reset();
    ImGui::EndDisabled();
    if (f.changed() && !led) c.apply(SetNode{id, node}, f.gesture());
}

} // namespace blush
