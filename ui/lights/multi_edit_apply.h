// Multi-edit: applies an edit of one light to all selected lights.
#pragma once

#include "ui/panel_context.h"

namespace blush {

// Sets the light to `after`; if several lights are selected, the others get the same edit (multi_edit.h). One undo step.
bool set_light(PanelContext& c, Id<Light> light, const Light& after, Gesture gesture);

// Toggles an object in the selected light's light linking or shadow linking, and shows a message. False if no light is selected
// or the object is the light.
bool toggle_link(PanelContext& c, Id<Node> object, ObjectSet Light::*set);

// "3 lights are edited together. They differ in kind and intensity."; empty for a single light.
std::string about_selected_lights(const PanelContext& c);

} // namespace blush
