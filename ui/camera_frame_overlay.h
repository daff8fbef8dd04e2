// What the picture shows of the camera that it is composed for.
#pragma once

#include "ui/gizmo.h"
#include "ui/panels/context.h"

#include <imgui.h>

namespace blush {

// The passepartout and the frame's edge while the camera is looked through; else, where there is a camera, which key goes back to it.
// `seen`: the part of the picture that is in the window.
void draw_camera_frame(PanelContext& c, ImDrawList& draw, const ImageRect& picture, const ImageRect& seen);

// Moves the camera to where the view is, if it is locked to the view.
void carry_camera_along(PanelContext& c);

} // namespace blush
