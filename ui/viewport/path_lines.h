// The path tool in the image: the traced paths as lines in the scene.
#pragma once

#include "ui/panel_context.h"
#include "ui/transform/gizmo.h"

#include <imgui.h>

namespace blush {

// Takes up what the tool's thread has traced, and gives it what it has to do. Without cost while the panel is closed.
void follow_paths(PanelContext& c);
// Traces the paths of a region of the image, in the scene and view as they are now.
void trace_paths_of(PanelContext& c, const ImageRegion& region);

// Other paths thin, the shown one on top of them. Lines have the hue of the throughput and a width by the path's contribution; shadow rays
// are dashed, blocked ones red up to what blocks them.
void draw_path_lines(ImDrawList& draw, const ImageRect& image, const Projection& projection, const PathsView& view);
// The most other paths that are drawn.
constexpr size_t most_drawn_paths = 200;

} // namespace blush
