// The bleed probe in the image: the probed place, a line from each sender, as wide as its share of the light, and the map of the greatest
// senders.
#pragma once

#include "ui/viewport/viewport_marks.h"
#include "ui/views/bleed_view.h"

#include <imgui.h>

namespace blush {

// `width` and `height`: of the full image.
void draw_bleed(ImDrawList& draw, const ImageRect& image, const Projection& projection, const Scene& scene, const BleedView& view,
                int width, int height);

} // namespace blush
