// A dial in a corner of the image that shows the environment's rotation: top view, the view direction is up. A sky shows its
// sun.
#pragma once

#include "ui/panel_context.h"
#include "ui/transform/gizmo.h"

#include <imgui.h>

namespace blush {

// Position of a direction on the dial: the zenith in the centre, the horizon and everything below on the rim. x to the right, y
// down, rim 1.
ScreenPoint dial_point(const Vec3d& direction, const Vec3d& view_forward);

// Draws it; a click opens the World tab. Returns true if the dial uses the left button. `seen`: the visible part of the
// image.
bool draw_environment_dial(PanelContext& c, ImDrawList& draw, const Projection& projection, const ImageRect& seen, bool hovered);

// Pixels from the left edge of the image that the dial takes at the lower edge; 0 if it is not shown.
float environment_dial_width(const PanelContext& c);

} // namespace blush
