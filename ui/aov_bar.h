// The viewport's own bar: which plane of the film is looked at; and the scale of planes that are maps.
#pragma once

#include "ui/aov_view.h"
#include "ui/gizmo.h"
#include "ui/panels/context.h"

#include <imgui.h>

namespace blush {

// Looks at another plane. Says so if the render restarts for it.
void show_aov(PanelContext& c, const AovView& view);
// A drop-down at the upper right corner of what is seen of the picture; not while pictures are compared, which have a label there.
void draw_aov_bar(PanelContext& c, const ImageRect& seen);
// The scale beside the picture, if the view is a map that has one.
void draw_map_scale(ImDrawList& draw, const ImageRect& seen, const Frame& frame, const PictureView& view);

} // namespace blush
