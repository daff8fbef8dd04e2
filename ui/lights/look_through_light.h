// Light camera mode of the viewport: view and light move together.
#pragma once

#include "ui/panel_context.h"

namespace blush {

// The light of the light camera; null if the mode is off.
const Light* light_camera_light(const PanelContext& c);
// Moves the view to the light, after any edit of the light. Ends the mode if the light was deleted.
void move_view_to_light(PanelContext& c);
// Moves the light to the view, after navigation.
void move_light_to_view(PanelContext& c);

} // namespace blush
