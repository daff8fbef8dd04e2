// The camera's frame in the image: the area outside its aspect ratio is dimmed (passepartout) or not rendered.
#pragma once

#include "scene/scene.h"
#include "scene/view_settings.h"
#include "ui/transform/gizmo.h"
#include "ui/window/layout.h"

#include <map>

namespace blush {

struct CameraFrame {
    float aspect = 0;                      // width / height; 0: the frame is the whole image; set by settle()
    bool fit = false;                      // render only the frame; otherwise the image extends beyond it
    bool lock = false;                     // navigating moves the camera; set by settle()
    std::map<Id<Camera>, float> from_file; // aspect ratios of the file's cameras
};

// The aspect ratio of the camera in the file; 0: none.
float aspect_in_file(const CameraFrame& frame, const Scene& scene, Id<Node> camera_node);

// Reads aspect ratio and lock from the settings saved with the scene. If they have no aspect ratio, the camera's own is used.
void settle(CameraFrame& frame, const ViewSettings& view, const Scene& scene, Id<Node> camera_node);

struct ImageSize {
    int width = 1, height = 1;
};
// Resolution for a viewport of this size. If the frame is wider than the viewport, or `fit` is set, the frame is the whole
// image: the field of view is that of the frame's height.
ImageSize image_size(const CameraFrame& frame, int viewport_width, int viewport_height);

// The frame's rectangle in an image, in units of the image's height; the whole image without an aspect ratio, or if it is
// not wider than the frame.
ImageRect frame_in_image(const CameraFrame& frame, const ImageRect& image);

} // namespace blush
