#include "ui/transform/handles.h"

#include "ui/lights/light_outline.h"
#include "ui/lights/light_tools.h"
#include "ui/lights/multi_edit.h"
#include "ui/lights/multi_edit_apply.h"
#include "ui/transform/rotation.h"
#include "ui/transform/transform_view.h"
#include "ui/viewport/orbit_camera.h"
#include "ui/viewport/picking.h"
#include "ui/window/theme.h"

namespace blush {
namespace {

ImU32 color_of(Handle handle) {
    switch (handle) {
    case Handle::move_x:
    case Handle::rotate_x:
    case Handle::scale_x: return tone::axis_x;
    case Handle::move_y:
    case Handle::rotate_y:
    case Handle::scale_y: return tone::axis_y;
    case Handle::move_z:
    case Handle::rotate_z:
    case Handle::scale_z: return tone::axis_z;
    case Handle::rotate: return tone::text;
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

void draw_ring(ImDrawList& draw, const HandleShape& s, ImU32 color, ImU32 shade, float width) {
    std::vector<ImVec2> line;
    for (const ScreenPoint& p : s.ring) line.push_back({p.x, p.y});
    draw.AddPolyline(line.data(), int(line.size()), shade, 0, width * 1.8f);
    draw.AddPolyline(line.data(), int(line.size()), color, 0, s.handle == Handle::rotate ? width * 0.6f : width);
}

void draw_box(ImDrawList& draw, const ImVec2& at, float half, ImU32 color, ImU32 shade) {
    draw.AddRectFilled({at.x - half * 1.35f, at.y - half * 1.35f}, {at.x + half * 1.35f, at.y + half * 1.35f}, shade);
    draw.AddRectFilled({at.x - half, at.y - half}, {at.x + half, at.y + half}, color);
}

void draw_shape(ImDrawList& draw, const HandleShape& s, bool lit) {
    const float em = ImGui::GetFontSize(), width = std::max(1.5f, em / 8);
    const ImVec2 from{s.from.x, s.from.y}, grip{s.grip.x, s.grip.y};
    const ImU32 color = lit ? IM_COL32_WHITE : color_of(s.handle), shade = IM_COL32(0, 0, 0, 120);
    if (!s.ring.empty()) {
        draw_ring(draw, s, color, shade, width);
    } else if (s.handle == Handle::aim) {
        draw.AddLine(from, grip, shade, width * 1.6f);
        draw.AddLine(from, grip, color, width * 0.6f);
        draw.AddCircle(grip, em * 0.45f, shade, 0, width * 1.8f);
        draw.AddCircle(grip, em * 0.45f, color, 0, width);
        draw.AddCircleFilled(grip, em * 0.14f, color);
    } else if (is_size(s.handle)) {
        draw_box(draw, grip, em * 0.24f, color, shade);
    } else if (s.handle == Handle::scale) {
        draw.AddRect({grip.x - em * 0.6f, grip.y - em * 0.6f}, {grip.x + em * 0.6f, grip.y + em * 0.6f}, shade, 0, 0, width * 1.6f);
        draw.AddRect({grip.x - em * 0.6f, grip.y - em * 0.6f}, {grip.x + em * 0.6f, grip.y + em * 0.6f}, color, 0, 0, width * 0.8f);
    } else if (s.handle == Handle::move) {
        draw.AddCircle(grip, em * 0.8f, shade, 0, width * 1.6f);
        draw.AddCircle(grip, em * 0.8f, color, 0, width * 0.8f);
    } else {
        draw.AddLine(from, grip, shade, width * 1.8f);
        draw.AddLine(from, grip, color, width);
        if (is_of_gizmo(s.handle, TransformMode::scale)) return draw_box(draw, grip, em * 0.26f, color, shade);
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
    case Handle::rotate: return "Rotate";
    case Handle::rotate_x: return "Rotate X";
    case Handle::rotate_y: return "Rotate Y";
    case Handle::rotate_z: return "Rotate Z";
    case Handle::scale: return "Scale";
    case Handle::scale_x: return "Scale X";
    case Handle::scale_y: return "Scale Y";
    case Handle::scale_z: return "Scale Z";
    case Handle::aim: return "Aim";
    case Handle::width: return "Width";
    case Handle::height: return "Height";
    case Handle::radius: return "Radius";
    case Handle::outer_cone: return "Cone";
    case Handle::inner_cone: return "Inner cone";
    case Handle::spread: return "Spread";
    case Handle::sun_angle: return "Angle";
    }
    return "";
}

const Light* light_of(const Scene& scene, const Node* node) { return node ? scene.lights.find(node->light) : nullptr; }

float gizmo_size() { return ImGui::GetFontSize() * 5; }

TransformRequest request_of(Handle handle, const TransformView& view) {
    const int axis = axis_of(handle);
    const bool on_ring = view.gizmo == TransformMode::rotate && axis >= 0;
    return {view.gizmo, {.axis = axis, .local = axis >= 0 && view.local}, true, on_ring ? gizmo_size() : 0};
}

// True if a node has a light with a direction: it can be aimed.
bool can_aim(const Scene& scene, Id<Node> id) {
    const Light* light = light_of(scene, scene.nodes.find(id));
    return light && has_direction(light->kind);
}

} // namespace

Vec3d Handles::anchor(const Scene& scene, std::span<const TransformTarget> targets) {
    Vec3d sum{0, 0, 0};
    for (const TransformTarget& target : targets) {
        const Affined& world_from = target.world_from_node;
        const Node& node = *scene.nodes.find(target.node);
        const Mesh* mesh = scene.meshes.find(node.mesh);
        const uint64_t geometry = mesh && !mesh->parts.empty() && mesh->parts[0].geometry ? mesh->parts[0].geometry->serial : 0;
        const auto [kept, is_new] = anchors_.try_emplace(target.node);
        Anchor& anchor = kept->second;
        if (is_new || anchor.geometry != geometry) {
            const bool placed = std::abs(determinant(world_from)) > 1e-300;
            anchor = {geometry, placed ? transform_point(inverse(world_from), handle_point(scene, target.node)) : Vec3d{0, 0, 0}};
        }
        sum = sum + transform_point(world_from, anchor.local);
    }
    return sum / double(targets.size());
}

void Handles::grab(PanelContext& c, Handle handle, const std::optional<LightInView>& seen, const ViewRay& ray) {
    dragged_ = handle;
    start_ray_ = ray;
    start_in_view_ = seen;
    grabbed_.clear();
    for (const Id<Node> id : subtree_roots(c.scene(), c.ui.selection(c.scene())))
        grabbed_.push_back({id, world_from_node(c.scene(), id).t});
    c.ui.gestures.begin();
}

void Handles::aim(PanelContext& c, const Projection& projection, double u, double v) {
    const Id<Node> primary = c.ui.selected;
    const Vec3d origin = world_from_node(c.scene(), primary).t;
    const Vec3d old_target = origin + rotate(world_rotation(c.scene(), primary), {0, 0, -1}) * aim_distance_;
    // Aims at the surface under the mouse; beside all objects, at the depth of the last target.
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
    case Handle::aim: return aim(c, projection, u, v);
    case Handle::width:
    case Handle::height:
    case Handle::radius:
    case Handle::outer_cone:
    case Handle::inner_cone:
    case Handle::spread:
    case Handle::sun_angle:
        set_light(c, c.scene().nodes.find(c.ui.selected)->light,
                  resized(*start_in_view_, dragged_, projection, start_ray_, projection.ray(u, v)), c.ui.gestures.current());
        break;
    default: break;
    }
}

std::optional<LightInView> Handles::light_in_view(const Scene& scene, Id<Node> id, const Projection& projection,
                                                  const ImageRect& image) const {
    const Light* light = light_of(scene, scene.nodes.find(id));
    const Affined m = world_from_node(scene, id);
    const auto seen = projection.project(m.t);
    if (!light || !seen) return {};
    return LightInView{*light, m, world_rotation(scene, id), outline_reach(projection, seen->distance),
                       projection.height_at(seen->distance) * ImGui::GetFontSize() / image.height};
}

std::vector<HandleShape> Handles::shapes(const PanelContext& c, std::span<const TransformTarget> targets, const Vec3d& position,
                                         const Projection& projection, const ImageRect& image,
                                         const std::optional<LightInView>& seen) const {
    const Scene& scene = c.scene();
    const TransformView& view = c.ui.transform;
    std::optional<Vec3d> aim_at;
    if (can_aim(scene, c.ui.selected))
        aim_at = world_from_node(scene, c.ui.selected).t + rotate(world_rotation(scene, c.ui.selected), {0, 0, -1}) * aim_distance_;
    GizmoPlace place{.mode = view.gizmo, .position = position, .size = gizmo_size()};
    if (view.local) place.axes = local_axes(scene, c.ui.selected);
    if (view.gizmo == TransformMode::scale) place.along_axes = scales_along_axes(targets);
    std::vector<HandleShape> shapes = handle_shapes(projection, image, place, aim_at);
    if (shapes.empty()) return shapes;
    if (!why_not(scene, targets, view.gizmo).empty())
        std::erase_if(shapes, [&](const HandleShape& s) { return is_of_gizmo(s.handle, view.gizmo); });
    const auto centre = projection.project(world_from_node(scene, c.ui.selected).t);
    if (!seen || !centre) return shapes;
    for (const SizeHandle& size : size_handles(*seen, projection))
        if (const auto grip = projection.project(size.grip)) shapes.push_back({size.handle, image.at(*centre), image.at(*grip)});
    return shapes;
}

bool Handles::update(PanelContext& c, ImDrawList& draw, const Projection& projection, const ImageRect& image, bool hovered) {
    const bool can_be_moved = c.scene().nodes.contains(c.ui.selected) && is_visible(c.scene(), c.ui.selected);
    const std::vector<TransformTarget> targets =
        can_be_moved ? transform_targets(c.scene(), c.ui.selection(c.scene())) : std::vector<TransformTarget>{};
    if (targets.empty() || c.ui.transform.active) {
        dragged_ = Handle::none;
        return false;
    }
    if (c.ui.selected != aimed_) {
        aimed_ = c.ui.selected;
        aim_distance_ = std::max(length(pivot(c.scene().view) - world_from_node(c.scene(), aimed_).t), 1e-3);
    }
    if (dragged_ != Handle::none) drag(c, projection, image);
    const auto seen = light_in_view(c.scene(), c.ui.selected, projection, image);
    const std::vector<HandleShape> handles = shapes(c, targets, anchor(c.scene(), targets), projection, image, seen);

    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool free = hovered && dragged_ == Handle::none && !ImGui::GetIO().KeyAlt && !ImGui::GetIO().KeyCtrl && !ImGui::GetIO().KeyShift;
    const Handle under = free ? handle_under(handles, {mouse.x, mouse.y}, ImGui::GetFontSize() * 0.8f) : dragged_;
    for (const HandleShape& shape : handles) {
        draw_shape(draw, shape, shape.handle == under);
        c.ui.probe.record(std::string("Handle/") + name_of(shape.handle), {shape.grip.x - 1, shape.grip.y - 1, 2, 2});
    }
    if (free && under != Handle::none && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        if (is_of_gizmo(under, c.ui.transform.gizmo))
            c.ui.transform.wanted = request_of(under, c.ui.transform);
        else
            grab(c, under, seen, projection.ray(image.u(mouse.x), image.v(mouse.y)));
    }
    if (dragged_ != Handle::none && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
        dragged_ = Handle::none;
        c.ui.gestures.end();
    }
    return under != Handle::none || dragged_ != Handle::none;
}

} // namespace blush
