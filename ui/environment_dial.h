// The environment as a dial in a corner of the picture: seen from above, what lies ahead of the view is up. A sky has its sun on it.
#pragma once

#include "ui/gizmo.h"
#include "ui/panels/context.h"

#include <imgui.h>

namespace blush {

// Where a direction lies on the dial: the zenith in the middle, the horizon and all below it on the rim. x to the right, y down, rim 1.
ScreenPoint dial_point(const Vec3d& direction, const Vec3d& view_forward);

// Draws it; a click on it opens the environment's tab. True if the left button is the dial's. `seen`: the part of the picture on the
// screen.
bool draw_environment_dial(PanelContext& c, ImDrawList& draw, const Projection& projection, const ImageRect& seen, bool hovered);

} // namespace blush
