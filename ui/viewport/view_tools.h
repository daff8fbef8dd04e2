// Tools that use the next click or drag in the image: eyedroppers, light meters and rectangles.
#pragma once

#include "ui/panel_context.h"
#include "ui/transform/gizmo.h"

#include <imgui.h>

namespace blush {

// The rectangle between two corners, clipped to the image.
ImageRegion region_between(double u0, double v0, double u1, double v1);

// Draws the frame of the measured region.
void draw_measured_region(ImDrawList& draw, const ImageRect& image, const ViewSettings& view);
// Draws the frame of the render region; covers the rest, unless the last whole image is shown there (region_backdrop.h).
void draw_rendered_region(ImDrawList& draw, const ImageRect& image, const ImageRegion& region, bool covers);

// Sets the render region.
void render_region(PanelContext& c, const ImageRegion& region);

// Shows the hint of the active tool over the visible part of the image, and executes the tool. True while a tool is active: the
// viewport then ignores the mouse.
bool use_tool(PanelContext& c, const Projection& projection, const ImageRect& image, bool hovered);

// Mean of the displayed image within `radius` pixels of (u, v), scene-linear; averaging reduces the noise.
Vec3 picked_color(const Frame& frame, const DenoisedImage* denoised, const ImageMix& mix, double u, double v, int radius);

} // namespace blush
