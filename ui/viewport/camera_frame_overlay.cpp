#include "ui/viewport/camera_frame_overlay.h"

#include "scene/affine.h"
#include "scene/animation/pose.h"
#include "ui/viewport/viewport_marks.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {
namespace {

constexpr ImU32 passepartout = IM_COL32(0, 0, 0, 255 - brightness_outside_frame), edge = IM_COL32(150, 150, 150, 160);

void draw_passepartout(ImDrawList& draw, const ImageRect& image, const ImageRect& frame) {
    const float bottom = image.y + image.height, right = frame.x + frame.width;
    draw.AddRectFilled({image.x, image.y}, {frame.x, bottom}, passepartout);
    draw.AddRectFilled({right, image.y}, {image.x + image.width, bottom}, passepartout);
}

} // namespace

std::optional<ImageRect> passepartout_of(const PanelContext& c, const ImageRect& image) {
    if (c.ui.light_camera || !is_at_home(c.scene(), c.ui.home)) return {};
    const ImageRect frame = frame_in_image(c.ui.frame, image);
    return frame.width == image.width ? std::nullopt : std::optional(frame);
}

void draw_camera_frame(PanelContext& c, ImDrawList& draw, const ImageRect& image, const ImageRect& seen, bool dimmed) {
    if (c.ui.light_camera) return;
    if (const auto frame = passepartout_of(c, image)) {
        if (!dimmed) draw_passepartout(draw, image, *frame);
        draw.AddRect({frame->x, frame->y}, {frame->x + frame->width, frame->y + frame->height}, edge);
        c.ui.probe.record("Camera frame", {frame->x, frame->y, frame->width, frame->height});
    }
    if (is_at_home(c.scene(), c.ui.home)) return;
    const Node* camera = c.scene().nodes.find(c.ui.home.camera);
    const std::string text = fmt::format("Free view.  {}: {}", to_string(shortcut(Command::camera_view).press),
                                         camera && !camera->name.empty() ? camera->name : "camera");
    // Beside the list of AOVs.
    const float em = ImGui::GetFontSize(), room = std::max(seen.width - 13 * em, 6 * em);
    const ImVec2 at{seen.x + em * 0.5f, seen.y + em * 0.75f}, size = draw_label(draw, text, at, room, tone::dim_text);
    c.ui.probe.record("Free view", {at.x, at.y, size.x, size.y});
}

std::optional<PixelRect> camera_frame_of(const UiState& ui, const Scene& scene, const Frame& image) {
    if (ui.light_camera || !is_at_home(scene, ui.home)) return {};
    const ImageRect frame = frame_in_image(ui.frame, {0, 0, float(image.width), float(image.height)});
    if (int(frame.width) >= image.width) return {};
    return PixelRect{int(frame.x), 0, int(frame.x) + std::max(int(frame.width), 1), image.height};
}

void move_camera_to_view(PanelContext& c) {
    const Id<Node> id = c.ui.home.camera;
    const Node* record = c.scene().nodes.find(id);
    if (!c.ui.frame.lock || c.ui.light_camera || !record || !record->camera || is_transform_animated(c.scene(), id)) return;
    Node node = *record;
    const View view = c.scene().view;
    node.local = placed_at(c.scene(), id, to_double(view.position), view.rotation);
    if (!c.apply(SetNode{id, node}, c.ui.gestures.current())) return;
    // Use the camera's exact pose: its transform is rounded, and the difference would count as a free view.
    View seen = view;
    const View eye = view_of_camera(c.scene(), id);
    seen.position = eye.position;
    seen.rotation = eye.rotation;
    c.document.navigate(seen);
}

} // namespace blush
