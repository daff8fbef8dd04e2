// Pixel borders and pixel values, drawn over the image at high zoom.
#pragma once

#include "render/frame.h"
#include "ui/transform/gizmo.h"
#include "ui/window/layout.h"

#include <imgui.h>

namespace blush {

// Lines from 8 screen pixels per pixel on; raw scene-linear red, green and blue from the zoom on at which they fit.
void draw_pixel_grid(ImDrawList& draw, const ImageRect& image, const Region& region, const Frame& frame);

} // namespace blush
