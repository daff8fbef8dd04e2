// What the window's commands do to lights, mostly to the selected ones.
#pragma once

#include "ui/panels/context.h"

namespace blush {

// Replaces the environment by a clear sky, and meters the exposure for it.
void light_by_sky(PanelContext& c);

// Off if any of them is on, else on.
void toggle_mute(PanelContext& c);
// Solo, unless all of them are.
void toggle_solo(PanelContext& c);
// A new group of the light mix for the selected lights, by a name that none has.
void group_lights(PanelContext& c);

// A click into the picture then places the selected light; the same command again ends it.
void toggle_placing(PanelContext& c, PlacingBy by);
// The view goes where the selected light is and moves it along, and back where it was.
void toggle_look_through(PanelContext& c);

} // namespace blush
