// Internal to the Light section: its groups of rows, one file each.
#pragma once

#include "ui/panel_context.h"
#include "ui/widgets/widgets.h"

namespace blush {

// Intensity in the user's unit, and colour. `area_scale`: factor by which the light's node enlarges areas.
void draw_light_strength(Fields& f, Light& light, double area_scale);
// Size and cone.
void draw_light_shape(Fields& f, Light& light);
// IES profile of a point or a spot.
void draw_light_distribution(Fields& f, PanelContext& c, Light& light);

} // namespace blush
