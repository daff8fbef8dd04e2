// The viewport's toolbar that selects the displayed AOV, and the colour scale of AOVs that are maps.
#pragma once

#include "ui/panel_context.h"
#include "ui/snapshots/aov_view.h"
#include "ui/transform/gizmo.h"

#include <imgui.h>

namespace blush {

// Switches to another AOV. Shows a message if the render restarts for it.
void show_aov(PanelContext& c, const AovView& view);
// A drop-down at the upper right corner of the visible image; hidden while images are compared, because the compare label is
// there.
void draw_aov_bar(PanelContext& c, const ImageRect& seen);
// The colour scale beside the image, if the AOV is a map that has one.
void draw_map_scale(ImDrawList& draw, const ImageRect& seen, const Frame& frame, const ImageView& view);

} // namespace blush
