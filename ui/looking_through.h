// Light camera mode of the viewport: view and light move together.
#pragma once

#include "ui/panels/context.h"

namespace blush {

// The light of the light camera; null if the mode is off.
const Light* looked_through_light(const PanelContext& c);
// Moves the view to the light, after any edit of the light. Ends the mode if the light was deleted.
void follow_looked_through(PanelContext& c);
// Moves the light to the view, after navigation.
void carry_light_along(PanelContext& c);

} // namespace blush
