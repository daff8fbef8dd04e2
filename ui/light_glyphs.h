// Lights drawn over the picture: an icon each, and size, cone and direction of the selected one.
#pragma once

#include "scene/scene.h"
#include "ui/gizmo.h"

#include <imgui.h>

namespace blush {

void draw_light_glyphs(ImDrawList& draw, const Scene& scene, const Projection& projection, const ImageRect& image, Id<Node> selected);
// The light whose icon is under the mouse; the nearest to the eye if several are.
Id<Node> light_under(const Scene& scene, const Projection& projection, const ImageRect& image, ScreenPoint mouse);

} // namespace blush
