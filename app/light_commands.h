// What the window's commands do to lights, mostly to the selected ones.
#pragma once

#include "scene/light_rig.h"
#include "ui/panels/context.h"

namespace blush {

// Adds a studio or a sky as one step, and meters the exposure for it.
void add_light_rig(PanelContext& c, LightRig rig);

// Off if any of them is on, else on.
void toggle_mute(PanelContext& c);
// Solo, unless all of them are.
void toggle_solo(PanelContext& c);
// A new group of the light mix for the selected lights, by a name that none has.
void group_lights(PanelContext& c);

// A click into the picture then places the selected light; the same command again ends it.
void toggle_placing(PanelContext& c, PlacingBy by);
// Opens the light mix, grouped by light at first; or closes it.
void toggle_light_mix(PanelContext& c);
// The view goes where the selected light is and moves it along, and back where it was.
void toggle_look_through(PanelContext& c);

} // namespace blush
