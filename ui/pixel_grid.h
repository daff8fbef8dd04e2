// The borders of pixels, and the numbers in them, where the picture is so large that there is room.
#pragma once

#include "render/frame.h"
#include "ui/gizmo.h"
#include "ui/layout.h"

#include <imgui.h>

namespace blush {

// Lines from 8 pixels of the screen on; values of the raw picture, scene-linear red, green and blue, from where they fit.
void draw_pixel_grid(ImDrawList& draw, const ImageRect& image, const Region& region, const Frame& frame);

} // namespace blush
