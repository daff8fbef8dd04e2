// Edits of one light that take the other selected lights along.
#pragma once

#include "ui/panels/context.h"

namespace blush {

// The light becomes `after`; if it is one of several that are selected, the others are edited alike (edit_together.h). One step of the
// history.
bool set_light(PanelContext& c, Id<Light> light, const Light& after, Gesture gesture);

// Takes an object out of what the selected light lights, or whose shadow it sees, or in again, and says so. False where no light is selected
// or the object is one.
bool toggle_link(PanelContext& c, Id<Node> object, ObjectSet Light::*set);

// "3 lights are edited together. They differ in kind and intensity."; empty for one alone.
std::string about_selected_lights(const PanelContext& c);

} // namespace blush
