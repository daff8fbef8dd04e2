// Lights drawn over the image: an icon each in the light's colour, with lines for size, cone and direction.
#pragma once

#include "scene/scene.h"
#include "ui/transform/gizmo.h"
#include "ui/window/ui_state.h"

#include <imgui.h>

namespace blush {

// Draws all lights except the one that the view looks through.
void draw_light_glyphs(ImDrawList& draw, const Scene& scene, const Projection& projection, const ImageRect& image, const UiState& ui);
// The light whose icon is under the mouse; if there are several, the nearest to the viewer.
Id<Node> light_under(const Scene& scene, const Projection& projection, const ImageRect& image, const UiState& ui, ScreenPoint mouse);

} // namespace blush
