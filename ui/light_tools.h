// What the window knows about lights beyond their record: units, new lights, angles. Pure.
#pragma once

#include "scene/edit.h"
#include "scene/light_units.h"

namespace blush {

const char* kind_name(Light::Kind kind);
// "cd", "lx" or "nits".
const char* intensity_unit(Light::Kind kind);
bool has_direction(Light::Kind kind);
// `light` as another kind that lights a surface `distance` metres away, facing it, as brightly as before.
Light converted(const Light& light, Light::Kind kind, double distance);

// The intensity, in its own unit, of a light that sends so many candela towards a surface `distance` metres away that it faces. A sun, which has
// no candela, gives the same illuminance there.
float intensity_towards(const Light& light, double candela, double distance);

// The rotation of surroundings, in -180 .. 180 degrees, that were dragged to the right by a share of the image's height: what was under the
// mouse in the middle of the picture goes along.
float turned_rotation(float rotation_degrees, double share, const Lens& lens);

// Where a direction points: degrees clockwise from -Z seen from above, and degrees above the horizon.
struct Heading {
    float heading = 0, tilt = 0;
};
Heading heading_of(const Vec3d& direction);
Vec3d direction_of(const Heading& heading);

// Where the -Z of a rotation points. Straight up or down, its +Y tells the heading.
Heading heading_of_rotation(const Quat& rotation);
// The rotation turned about the vertical to another heading, and about the horizontal axis across that heading to another tilt: it does not roll.
Quat with_heading(const Quat& rotation, const Heading& heading);

// The rotation turned the shortest way so that its -Z looks along `forward`.
Quat turned_to(const Quat& rotation, const Vec3d& forward);

} // namespace blush
