// Light meters in the image, each with its name and reading.
#pragma once

#include "ui/views/meters_view.h"

#include <imgui.h>

namespace blush {

void draw_meters(ImDrawList& draw, const ImageRect& image, const Projection& projection, const Scene& scene, const ViewSettings& view,
                 const MetersView& meters);

} // namespace blush
