#include "ui/handles.h"

#include "scene/pose.h"
#include "ui/edit_together.h"
#include "ui/light_outline.h"
#include "ui/light_tools.h"
#include "ui/orbit_camera.h"
#include "ui/picking.h"
#include "ui/rotation.h"
#include "ui/selected_lights.h"
#include "ui/theme.h"

namespace blush {
namespace {

ImU32 color_of(Handle handle) {
    switch (handle) {
    case Handle::move_x: return tone::axis_x;
    case Handle::move_y: return tone::axis_y;
    case Handle::move_z: return tone::axis_z;
    case Handle::aim:
    case Handle::width:
    case Handle::height:
    case Handle::radius:
    case Handle::outer_cone:
    case Handle::inner_cone:
    case Handle::spread:
    case Handle::sun_angle: return tone::light;
    default: return tone::accent;
    }
}

void draw_shape(ImDrawList& draw, const HandleShape& s, bool lit) {
    const float em = ImGui::GetFontSize(), width = std::max(1.5f, em / 8);
    const ImVec2 from{s.from.x, s.from.y}, grip{s.grip.x, s.grip.y};
    const ImU32 color = lit ? IM_COL32_WHITE : color_of(s.handle), shade = IM_COL32(0, 0, 0, 120);
    if (s.handle == Handle::aim) {
        draw.AddLine(from, grip, shade, width * 1.6f);
        draw.AddLine(from, grip, color, width * 0.6f);
        draw.AddCircle(grip, em * 0.45f, shade, 0, width * 1.8f);
        draw.AddCircle(grip, em * 0.45f, color, 0, width);
        draw.AddCircleFilled(grip, em * 0.14f, color);
    } else if (is_size(s.handle)) {
        const float half = em * 0.24f;
        draw.AddRectFilled({grip.x - half * 1.35f, grip.y - half * 1.35f}, {grip.x + half * 1.35f, grip.y + half * 1.35f}, shade);
        draw.AddRectFilled({grip.x - half, grip.y - half}, {grip.x + half, grip.y + half}, color);
    } else if (s.handle == Handle::move) {
        draw.AddCircle(grip, em * 0.8f, shade, 0, width * 1.6f);
        draw.AddCircle(grip, em * 0.8f, color, 0, width * 0.8f);
    } else {
        draw.AddLine(from, grip, shade, width * 1.8f);
        draw.AddLine(from, grip, color, width);
        draw.AddCircleFilled(grip, em * 0.32f, shade);
        draw.AddCircleFilled(grip, em * 0.26f, color);
    }
}

const char* name_of(Handle handle) {
    switch (handle) {
    case Handle::none: break;
    case Handle::move: return "Move";
    case Handle::move_x: return "Move X";
    case Handle::move_y: return "Move Y";
    case Handle::move_z: return "Move Z";
    case Handle::aim: return "Aim";
    case Handle::width: return "Width";
    case Handle::height: return "Height";
    case Handle::radius: return "Radius";
    case Handle::outer_cone: return "Cone";
    case Handle::inner_cone: return "Full inside";
    case Handle::spread: return "Spread";
    case Handle::sun_angle: return "Angle";
    }
    return "";
}

const Light* light_of(const Scene& scene, const Node* node) { return node ? scene.lights.find(node->light) : nullptr; }

// A node with a light that has a direction can be aimed.
bool can_aim(const Scene& scene, Id<Node> id) {
    const Light* light = light_of(scene, scene.nodes.find(id));
    return light && has_direction(light->kind);
}

} // namespace

Vec3d Handles::anchor(const Scene& scene, Id<Node> id, const Node& node) {
    const Affined world_from = world_from_node(scene, id);
    const Mesh* mesh = scene.meshes.find(node.mesh);
    const uint64_t geometry = mesh && !mesh->parts.empty() && mesh->parts[0].geometry ? mesh->parts[0].geometry->serial : 0;
    if (id != node_ || geometry != geometry_) {
        node_ = id;
        geometry_ = geometry;
        local_anchor_ = {0, 0, 0};
        const Bounds bounds = node.mesh ? world_bounds(scene, id) : Bounds{};
        if (!bounds.empty && std::abs(determinant(world_from)) > 1e-300)
            local_anchor_ = transform_point(inverse(world_from), bounds.center());
        aim_distance_ = std::max(length(pivot(scene.view) - world_from.t), 1e-3);
    }
    return transform_point(world_from, local_anchor_);
}

void Handles::grab(PanelContext& c, Handle handle, const Vec3d& position, const std::optional<LightSight>& seen, const ViewRay& ray) {
    dragged_ = handle;
    start_anchor_ = position;
    start_ray_ = ray;
    start_sight_ = seen;
    grabbed_.clear();
    for (const Id<Node> id : topmost(c.scene(), c.ui.selection(c.scene()))) grabbed_.push_back({id, world_from_node(c.scene(), id).t});
    c.ui.gestures.begin();
}

void Handles::move(PanelContext& c, const Vec3d& by) {
    std::vector<Edit> edits;
    for (const Grabbed& g : grabbed_) {
        const Node* node = c.scene().nodes.find(g.node);
        if (!node) continue;
        Node moved = *node;
        moved.local = moved_to(c.scene(), g.node, g.origin + by);
        edits.push_back(SetNode{g.node, moved});
    }
    if (!edits.empty()) c.apply(edits, edits.size() == 1 ? label(edits[0], c.project()) : "Move objects", c.ui.gestures.current());
}

void Handles::aim(PanelContext& c, const Projection& projection, double u, double v) {
    const Id<Node> primary = c.ui.selected;
    const Vec3d origin = world_from_node(c.scene(), primary).t;
    const Vec3d old_target = origin + rotate(world_rotation(c.scene(), primary), {0, 0, -1}) * aim_distance_;
    // At what is seen under the mouse; beside everything, at the depth of the last target.
    std::optional<Vec3d> target;
    if (c.frame && pick(*c.frame, u, v).node != primary) target = seen_point(*c.frame, projection, u, v);
    if (!target) target = meet_plane(projection.ray(u, v), old_target, projection.forward());
    if (!target || length(*target - origin) < 1e-6) return;
    aim_distance_ = length(*target - origin);
    std::vector<Edit> edits;
    for (const Grabbed& g : grabbed_) {
        const Vec3d to = *target - g.origin;
        if (!can_aim(c.scene(), g.node) || length(to) < 1e-6) continue;
        Node node = *c.scene().nodes.find(g.node);
        node.local = rotated_to(c.scene(), g.node, turned_to(world_rotation(c.scene(), g.node), to));
        edits.push_back(SetNode{g.node, node});
    }
    if (!edits.empty()) c.apply(edits, edits.size() == 1 ? label(edits[0], c.project()) : "Aim lights", c.ui.gestures.current());
}

void Handles::drag(PanelContext& c, const Projection& projection, const ImageRect& image) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const double u = image.u(mouse.x), v = image.v(mouse.y);
    switch (dragged_) {
    case Handle::none: break;
    case Handle::move:
    case Handle::move_x:
    case Handle::move_y:
    case Handle::move_z:
        return move(c, dragged_position(dragged_, projection, start_ray_, projection.ray(u, v), start_anchor_) - start_anchor_);
    case Handle::aim: return aim(c, projection, u, v);
    case Handle::width:
    case Handle::height:
    case Handle::radius:
    case Handle::outer_cone:
    case Handle::inner_cone:
    case Handle::spread:
    case Handle::sun_angle:
        set_light(c, c.scene().nodes.find(c.ui.selected)->light, resized(*start_sight_, dragged_, projection, start_ray_, projection.ray(u, v)),
                  c.ui.gestures.current());
        break;
    }
}

std::optional<LightSight> Handles::sight(const Scene& scene, Id<Node> id, const Projection& projection, const ImageRect& image) const {
    const Light* light = light_of(scene, scene.nodes.find(id));
    const Affined m = world_from_node(scene, id);
    const auto seen = projection.project(m.t);
    if (!light || !seen) return {};
    return LightSight{*light, m, world_rotation(scene, id), outline_reach(projection, seen->distance),
                      projection.height_at(seen->distance) * ImGui::GetFontSize() / image.height};
}

bool Handles::update(PanelContext& c, ImDrawList& draw, const Projection& projection, const ImageRect& image, bool hovered) {
    const Node* node = c.scene().nodes.find(c.ui.selected);
    if (!node || !is_visible(c.scene(), c.ui.selected) || node->skin || is_placed_by_clip(c.scene(), c.ui.selected)) {
        dragged_ = Handle::none;
        return false;
    }
    if (dragged_ != Handle::none) {
        drag(c, projection, image);
        node = c.scene().nodes.find(c.ui.selected);
    }
    const Vec3d position = anchor(c.scene(), c.ui.selected, *node);
    std::optional<Vec3d> aim_at;
    if (can_aim(c.scene(), c.ui.selected)) aim_at = position + rotate(world_rotation(c.scene(), c.ui.selected), {0, 0, -1}) * aim_distance_;
    const float em = ImGui::GetFontSize();
    std::vector<HandleShape> shapes = handle_shapes(projection, image, position, aim_at, em * 5);
    const auto seen = sight(c.scene(), c.ui.selected, projection, image);
    if (seen && !shapes.empty()) {
        for (const SizeHandle& size : size_handles(*seen, projection))
            if (const auto grip = projection.project(size.grip)) shapes.push_back({size.handle, shapes[0].from, image.at(*grip)});
    }

    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool free = hovered && dragged_ == Handle::none && !ImGui::GetIO().KeyAlt && !ImGui::GetIO().KeyCtrl && !ImGui::GetIO().KeyShift;
    const Handle under = free ? handle_under(shapes, {mouse.x, mouse.y}, em * 0.8f) : dragged_;
    for (const HandleShape& shape : shapes) {
        draw_shape(draw, shape, shape.handle == under);
        c.ui.probe.record(std::string("Handle/") + name_of(shape.handle), {shape.grip.x - 1, shape.grip.y - 1, 2, 2});
    }
    if (free && under != Handle::none && ImGui::IsMouseClicked(ImGuiMouseButton_Left))
        grab(c, under, position, seen, projection.ray(image.u(mouse.x), image.v(mouse.y)));
    if (dragged_ != Handle::none && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
        dragged_ = Handle::none;
        c.ui.gestures.end();
    }
    return under != Handle::none || dragged_ != Handle::none;
}

} // namespace blush
