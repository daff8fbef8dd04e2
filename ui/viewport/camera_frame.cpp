#include "ui/viewport/camera_frame.h"

#include <algorithm>
#include <cmath>

namespace blush {

float aspect_in_file(const CameraFrame& frame, const Scene& scene, Id<Node> camera_node) {
    const Node* node = scene.nodes.find(camera_node);
    const auto found = node ? frame.from_file.find(node->camera) : frame.from_file.end();
    return found == frame.from_file.end() ? 0 : found->second;
}

void settle(CameraFrame& frame, const ViewSettings& view, const Scene& scene, Id<Node> camera_node) {
    frame.aspect = view.frame_aspect ? *view.frame_aspect : aspect_in_file(frame, scene, camera_node);
    frame.lock = view.lock_camera;
}

ImageSize image_size(const CameraFrame& frame, int viewport_width, int viewport_height) {
    const ImageSize viewport{std::max(viewport_width, 1), std::max(viewport_height, 1)};
    if (frame.aspect <= 0) return viewport;
    const bool wider = frame.aspect > float(viewport.width) / float(viewport.height);
    if (!wider && !frame.fit) return viewport;
    const Region fitted = fit_aspect({0, 0, float(viewport.width), float(viewport.height)}, frame.aspect);
    return {int(fitted.width), int(fitted.height)};
}

ImageRect frame_in_image(const CameraFrame& frame, const ImageRect& image) {
    const float width = std::round(image.height * frame.aspect);
    if (frame.aspect <= 0 || width >= image.width - 1) return image;
    return {std::round(image.x + (image.width - width) / 2), image.y, width, image.height};
}

} // namespace blush
