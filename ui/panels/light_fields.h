// Internal to the light inspector: its groups of rows, a file each.
#pragma once

#include "ui/panels/context.h"
#include "ui/widgets.h"

namespace blush {

// How bright, in the unit of the user's choice, and of which colour. `area_scale`: by how much the light's node makes areas larger.
void draw_light_strength(Fields& f, Light& light, double area_scale);
// How large, and into which cone.
void draw_light_shape(Fields& f, Light& light);
// The measured distribution of a point or a spot.
void draw_light_distribution(Fields& f, PanelContext& c, Light& light);

} // namespace blush
