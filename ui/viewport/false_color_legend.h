// The legend of the false colours, drawn over the image.
#pragma once

#include "scene/view_settings.h"
#include "ui/transform/gizmo.h"

#include <imgui.h>

namespace blush {

// Along the left edge of the image: the colours, the values at their boundaries, and the unit. Nothing if false colours are
// off.
void draw_false_color_legend(ImDrawList& draw, const ImageRect& image, const ViewSettings& view);

} // namespace blush
