// Polar plot of a light's candela by direction, as on photometric data sheets.
#pragma once

#include "scene/lights/ies_profile.h"

#include <vector>

namespace blush {

// A point of the plot, in units of the peak intensity: (0, -1) is straight ahead.
struct PolarPoint {
    double x, y;
};
// The curve in the plane through the light's axis, rotated by `turn_degrees` from its X towards its Y axis: right side from front
// to back, then the left side back. For a spot only within its cone.
std::vector<PolarPoint> polar_curve(const IesProfile& profile, const Light& light, double turn_degrees);

// Draws the curves of the light's XZ and YZ planes at the cursor with the available width, and advances the cursor.
void draw_polar_plot(const IesProfile& profile, const Light& light);

} // namespace blush
