// Light utilities: units, conversion between types, angles. Pure.
#pragma once

#include "scene/document/edit.h"
#include "scene/lights/light_units.h"

namespace blush {

// "cd", "lx" or "nits".
const char* intensity_unit(Light::Kind kind);
bool has_direction(Light::Kind kind);
// Converts `light` to another type that gives the same illuminance on a surface facing it at `distance` metres.
Light converted(const Light& light, Light::Kind kind, double distance);

// The intensity, in the light's own unit, for this many candela towards a surface facing it at `distance` metres. A sun, which
// has no candela, gets the same illuminance there.
float intensity_towards(const Light& light, double candela, double distance);

// The environment's rotation, in -180 .. 180 degrees, after a drag to the right by a fraction of the image's height. The point
// under the mouse at the image centre follows the mouse.
float turned_rotation(float rotation_degrees, double share, const Lens& lens);

// A direction as angles: degrees clockwise from -Z seen from above, and degrees above the horizon.
struct Heading {
    float heading = 0, tilt = 0;
};
Heading heading_of(const Vec3d& direction);
Vec3d direction_of(const Heading& heading);

// The direction of a rotation's -Z. If it is vertical, +Y gives the heading.
Heading heading_of_rotation(const Quat& rotation);
// The rotation changed to another heading (about the vertical axis) and another tilt (about the horizontal axis across that
// heading), without roll.
Quat with_heading(const Quat& rotation, const Heading& heading);

// The shortest rotation that turns -Z to `forward`, applied to `rotation`.
Quat turned_to(const Quat& rotation, const Vec3d& forward);

} // namespace blush
