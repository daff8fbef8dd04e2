// Moving the view: pure functions from a View and a gesture to the next View. World +Y is up.
#pragma once

#include "scene/scene.h"

namespace blush {

// The point that orbiting turns about.
Vec3d pivot(const View& view);

// Turns about the pivot; positive yaw carries the eye to its right, positive pitch upwards. Never tips over the poles.
View orbit(const View& view, double yaw_radians, double pitch_radians);
// Turns about the eye: positive yaw looks to the left, positive pitch up. The pivot turns along.
View look_around(const View& view, double yaw_radians, double pitch_radians);
// Slides the view so that the pivot's image follows a mouse that moved by these fractions of the image's height (y down).
View pan(const View& view, double dx, double dy);
// Scales the distance to the pivot (orthographic: the size of the view); below 1 comes closer.
View dolly(const View& view, double factor);
// Moves eye and pivot by metres along the view's right, up and forward.
View fly(const View& view, const Vec3d& right_up_forward);

} // namespace blush
