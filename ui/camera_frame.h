// The frame of the camera in the picture: what is outside of its aspect is dimmed (passepartout), or not rendered.
#pragma once

#include "scene/scene.h"
#include "scene/view_settings.h"
#include "ui/gizmo.h"
#include "ui/layout.h"

#include <map>

namespace blush {

struct CameraFrame {
    float aspect = 0;  // width over height; 0: the frame is the picture; settle() says it
    bool fit = false;  // the picture is the frame; else it goes on beside it
    bool lock = false; // navigating moves the camera; settle() says it
    std::map<Id<Camera>, float> from_file; // aspects of the file's cameras
};

// The aspect that the file gives the camera; 0: none.
float aspect_in_file(const CameraFrame& frame, const Scene& scene, Id<Node> camera_node);

// Takes aspect and lock from the settings that are saved with the scene; where they say no aspect it is that of the camera in the file.
void settle(CameraFrame& frame, const ViewSettings& view, const Scene& scene, Id<Node> camera_node);

struct PictureSize {
    int width = 1, height = 1;
};
// Pixels to render in a viewport of this size. A frame that is wider than the viewport, and one that is to fit, is the whole picture: the field
// of view is that of the frame's height.
PictureSize picture_size(const CameraFrame& frame, int viewport_width, int viewport_height);

// Where the frame lies in a picture, of the picture's height; the picture itself without an aspect, and where it is no wider than the frame.
ImageRect frame_in_picture(const CameraFrame& frame, const ImageRect& picture);

} // namespace blush
