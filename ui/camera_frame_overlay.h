// What the picture shows of the camera that it is composed for.
#pragma once

#include "ui/gizmo.h"
#include "ui/panels/context.h"

#include <imgui.h>
#include <optional>

namespace blush {

// The passepartout and the frame's edge while the camera is looked through; else, where there is a camera, which key goes back to it.
// `seen`: the part of the picture that is in the window.
void draw_camera_frame(PanelContext& c, ImDrawList& draw, const ImageRect& picture, const ImageRect& seen);

// The pixels of the camera's frame in a picture that goes on beside it while the camera is looked through; none: the picture is the frame.
std::optional<PixelRect> camera_frame_of(const UiState& ui, const Scene& scene, const Frame& picture);

// Moves the camera to where the view is, if it is locked to the view.
void carry_camera_along(PanelContext& c);

} // namespace blush
