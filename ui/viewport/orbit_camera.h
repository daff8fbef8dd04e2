// View navigation: pure functions from a View and a gesture to the next View. World +Y is up.
#pragma once

#include "scene/scene.h"

namespace blush {

// The pivot of orbiting.
Vec3d pivot(const View& view);

// Orbits about the pivot; positive yaw moves the viewer to its right, positive pitch upwards. Clamped at the poles.
View orbit(const View& view, double yaw_radians, double pitch_radians);
// Turns about the viewer: positive yaw looks to the left, positive pitch up. The pivot moves along.
View look_around(const View& view, double yaw_radians, double pitch_radians);
// Pans: the pivot's image follows a mouse movement, given as fractions of the image's height (y down).
View pan(const View& view, double dx, double dy);
// Dollies: scales the distance to the pivot (orthographic: the height of the view); below 1 moves closer.
View dolly(const View& view, double factor);
// Moves viewer and pivot by metres along the view's right, up and forward.
View fly(const View& view, const Vec3d& right_up_forward);

} // namespace blush
