// The two piles of light side by side in one image: direct | indirect | sum, with two wipes.
#pragma once

#include "ui/panel_context.h"
#include "ui/transform/gizmo.h"

namespace blush {

// Draws the wipes and the names of the parts over the visible part of the image, and moves the wipes.
void draw_two_piles(PanelContext& c, const ImageRect& image, const ImageRect& seen);

} // namespace blush
