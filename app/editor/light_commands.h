// Commands for lights, mostly for the selected ones.
#pragma once

#include "scene/lights/light_rig.h"
#include "ui/panel_context.h"

namespace blush {

// Adds studio or sky lighting as one undo step, and meters the exposure for it.
void add_light_rig(PanelContext& c, LightRig rig);

// Mutes all if any is on; else unmutes them.
void toggle_mute(PanelContext& c);
// Makes all solo, unless all of them are; then ends solo.
void toggle_solo(PanelContext& c);
// Puts the selected lights into a new light group with an unused name.
void group_lights(PanelContext& c);

// Toggles the tool that places the selected light with a click in the image.
void toggle_placing(PanelContext& c, PlacingBy by);
// Opens the light mix, first with groups by light; or closes it.
void toggle_light_mix(PanelContext& c);
// Toggles the light camera for the selected light.
void toggle_look_through(PanelContext& c);

} // namespace blush
