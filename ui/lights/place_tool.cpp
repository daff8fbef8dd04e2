#include "ui/lights/place_tool.h"

#include "render/lights/light_links.h"
#include "scene/affine.h"
#include "scene/geometry/ray_queries.h"
#include "scene/node_name.h"
#include "ui/viewport/viewport_marks.h"
#include "ui/widgets/elided_text.h"
#include "ui/window/theme.h"

namespace blush {
namespace {

const Light* light_at(const Scene& scene, Id<Node> id) {
    const Node* node = scene.nodes.find(id);
    return node ? scene.lights.find(node->light) : nullptr;
}

bool plain_click() {
    const ImGuiIO& io = ImGui::GetIO();
    return ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !io.KeyAlt && !io.KeyCtrl && !io.KeyShift;
}

double distance_between(const LightPose& pose, const Vec3d& point) { return std::max(length(pose.position - point), 1e-6); }

// The point, raised by about a pixel: its depth is a mean over the pixel, and may lie behind the surface.
Vec3d above_surface(const Projection& projection, const ImageRect& image, const SurfacePoint& spot) {
    const auto seen = projection.project(spot.position);
    return seen ? spot.position + spot.normal * (projection.height_at(seen->distance) / double(image.height)) : spot.position;
}

} // namespace

std::optional<SurfacePoint> PlaceTool::surface_under_mouse(PanelContext& c, const Projection& projection, const ImageRect& image) const {
    const FramePtr& frame = dragging_ ? surfaces_ : c.frame;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (!frame) return {};
    const auto spot = surface_at_pixel(*frame, projection, image.u(mouse.x), image.v(mouse.y));
    return spot && spot->node != node_ ? spot : std::nullopt;
}

std::optional<LightPose> PlaceTool::wanted(PanelContext& c, const Projection& projection, const ImageRect& image,
                                           const SurfacePoint& spot) const {
    const Light& light = *light_at(c.scene(), node_);
    const LightPose pose = dragging_ ? start_ : pose_of(c.scene(), node_);
    if (by_ == PlacingBy::highlight) {
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        const Vec3d view = projection.ray(image.u(mouse.x), image.v(mouse.y)).direction;
        return with_highlight_at(light, pose, spot, view, dragging_ ? distance_ : distance_between(pose, spot.position));
    }
    if (!occluder_) return {};
    return with_shadow_at(light, pose, *occluder_, spot.position, dragging_ ? distance_ : distance_between(pose, *occluder_));
}

void PlaceTool::press(PanelContext& c, const SurfacePoint& spot) {
    dragging_ = true;
    placed_ = by_ == PlacingBy::highlight || occluder_; // otherwise this press chooses the occluder, and a drag from it places the light
    surfaces_ = c.frame;
    start_ = pose_of(c.scene(), node_);
    pressed_at_ = ImGui::GetIO().MousePos;
    if (by_ == PlacingBy::highlight) occluder_node_ = {};
    if (by_ == PlacingBy::shadow && !occluder_) {
        occluder_ = spot.position;
        occluder_node_ = spot.node;
    }
    distance_ = distance_between(start_, by_ == PlacingBy::shadow ? *occluder_ : spot.position);
    c.ui.gestures.begin();
}

// The light is placed even if something blocks its path; warn the user about it.
void PlaceTool::warn_of_occluder(PanelContext& c) const {
    const Light* light = light_at(c.scene(), node_);
    if (!light || !effect_at_) return;
    const auto counts = [&](Id<Node> id) { return id != node_ && id != occluder_node_ && contains(light->shadow_casters, c.scene(), id); };
    Vec3d way = pose_of(c.scene(), node_).position - *effect_at_;
    if (light->kind == Light::Kind::sun) way = way * (1 + 2 * world_bounds(c.scene()).radius() / std::max(length(way), 1e-9));
    const auto blocker = first_occluder(c.scene(), *effect_at_, *effect_at_ + way, counts);
    if (!blocker) return;
    c.ui.toasts.warn(node_name(c.scene(), *blocker, *c.scene().nodes.find(*blocker)) + " is in the way",
                     by_ == PlacingBy::highlight ? "The light does not reach the position of the highlight."
                                                 : "Another object on the line to the light casts a shadow there as well.");
}

void PlaceTool::release(PanelContext& c) {
    if (placed_) warn_of_occluder(c);
    effect_at_.reset();
    if (placed_) occluder_.reset();
    dragging_ = false;
    surfaces_.reset();
    c.ui.gestures.end();
}

void PlaceTool::draw_preview(ImDrawList& draw, const Projection& projection, const ImageRect& image, const SurfacePoint& spot,
                             const std::optional<LightPose>& pose) const {
    const bool reached = !pose || faces(spot, pose->position);
    const WorldPen pen{draw, projection, image, reached ? tone::accent : tone::failure};
    const Vec3d x = any_perpendicular(spot.normal), y = cross(spot.normal, x);
    const auto seen = projection.project(spot.position);
    if (!seen) return;
    const double size = projection.height_at(seen->distance) * 0.025;
    pen.circle(spot.position, x * size, y * size);
    pen.line(spot.position, spot.position + spot.normal * (size * 2));
    if (occluder_) pen.cross(*occluder_, size * 0.6);
    if (pose) pen.line(spot.position, pose->position);
}

std::string PlaceTool::hint(const std::string& light) const {
    if (by_ == PlacingBy::highlight) return "Click or drag where the highlight of " + light + " should be.  Esc ends";
    if (!occluder_) return "Click the object that casts the shadow of " + light + ", or drag from it to the shadow's place.  Esc ends";
    return "Click or drag where that shadow should fall.  Esc ends";
}

bool PlaceTool::update(PanelContext& c, ImDrawList& draw, const Projection& projection, const ImageRect& image, bool hovered) {
    const Light* light = light_at(c.scene(), c.ui.selected);
    if (!light) c.ui.placing_by = PlacingBy::hand;
    if (c.ui.placing_by != by_ || c.ui.selected != node_) {
        if (dragging_) release(c);
        occluder_.reset();
        by_ = c.ui.placing_by;
        node_ = c.ui.selected;
    }
    if (by_ == PlacingBy::hand) return false;
    draw_hint(draw, hint(elided(node_name(c.scene(), node_, *c.scene().nodes.find(node_)), max_name_width())));
    const auto spot = hovered || dragging_ ? surface_under_mouse(c, projection, image) : std::nullopt;
    const bool pressed = hovered && !dragging_ && plain_click();
    if (pressed && spot) press(c, *spot);
    if (dragging_ && ImGui::IsMouseDragging(ImGuiMouseButton_Left)) placed_ = true;
    const auto pose = spot ? wanted(c, projection, image, *spot) : std::nullopt;
    if (dragging_ && placed_ && pose) effect_at_ = above_surface(projection, image, *spot);
    if (dragging_ && placed_ && pose) c.apply(SetNode{node_, with_pose(c.scene(), node_, *pose)}, c.ui.gestures.current());
    if (spot) draw_preview(draw, projection, image, *spot, pose);
    if (dragging_ && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) release(c);
    return pressed || dragging_;
}

} // namespace blush
