// The camera's frame in the picture: the area outside its aspect ratio is dimmed (passepartout) or not rendered.
#pragma once

#include "scene/scene.h"
#include "scene/view_settings.h"
#include "ui/transform/gizmo.h"
#include "ui/window/layout.h"

#include <map>

namespace blush {

struct CameraFrame {
    float aspect = 0;                      // width / height; 0: the frame is the whole picture; set by settle()
    bool fit = false;                      // render only the frame; otherwise the picture extends beyond it
    bool lock = false;                     // navigating moves the camera; set by settle()
    std::map<Id<Camera>, float> from_file; // aspect ratios of the file's cameras
};

// The aspect ratio of the camera in the file; 0: none.
float aspect_in_file(const CameraFrame& frame, const Scene& scene, Id<Node> camera_node);

// Reads aspect ratio and lock from the settings saved with the scene. If they have no aspect ratio, the camera's own is used.
void settle(CameraFrame& frame, const ViewSettings& view, const Scene& scene, Id<Node> camera_node);

struct PictureSize {
    int width = 1, height = 1;
};
// Resolution for a viewport of this size. If the frame is wider than the viewport, or `fit` is set, the frame is the whole
// picture: the field of view is that of the frame's height.
PictureSize picture_size(const CameraFrame& frame, int viewport_width, int viewport_height);

// The frame's rectangle in a picture, in units of the picture's height; the whole picture without an aspect ratio, or if it is
// not wider than the frame.
ImageRect frame_in_picture(const CameraFrame& frame, const ImageRect& picture);

} // namespace blush
