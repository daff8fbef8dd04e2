// A light's candela by direction, as photometric sheets draw it.
#pragma once

#include "scene/ies_profile.h"

#include <vector>

namespace blush {

// A point of the plot, in units of the peak: (0, -1) straight ahead of the light.
struct PolarPoint {
    double x, y;
};
// The curve of the plane through the light's axis that is turned by `turn_degrees` from its X towards its Y: to the right from ahead to
// behind, then back on the left. Within the light's cone alone if it is a spot.
std::vector<PolarPoint> polar_curve(const IesProfile& profile, const Light& light, double turn_degrees);

// Draws the curves of the light's XZ and YZ planes at the cursor, as wide as there is room, and moves on.
void draw_polar_plot(const IesProfile& profile, const Light& light);

} // namespace blush
