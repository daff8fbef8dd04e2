// Tools that take the next click or drag in the picture: picking white, and drawing rectangles.
#pragma once

#include "ui/gizmo.h"
#include "ui/panels/context.h"

#include <imgui.h>

namespace blush {

// The rectangle between two corners, clipped to the picture.
PictureRegion region_between(double u0, double v0, double u1, double v1);

// The measured region's frame, over the picture.
void draw_measured_region(ImDrawList& draw, const ImageRect& image, const ViewSettings& view);
// The frame of the region that is rendered alone; covers the rest, unless something of it is shown (region_surroundings.h).
void draw_rendered_region(ImDrawList& draw, const ImageRect& image, const PictureRegion& region, bool covers);

// From now on this alone is rendered.
void render_region(PanelContext& c, const PictureRegion& region);

// Says over the part of the picture that is seen what the tool waits for, and does it. True while a tool is in hand: the mouse is then not
// the viewport's.
bool use_tool(PanelContext& c, const Projection& projection, const ImageRect& image, const ImageRect& seen, bool hovered);

// Mean of what is shown within `radius` pixels of (u, v), scene-linear: of one pixel alone noise would be picked too.
Vec3 picked_color(const Frame& frame, const DenoisedPicture* denoised, const PictureMix& mix, double u, double v, int radius);

} // namespace blush
