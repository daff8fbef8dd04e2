// Position of the sun in the sky by place and time.
#pragma once

#include "scene/scene.h"

namespace blush {

// Degrees above the horizon, and clockwise from north.
struct SunPosition {
    double elevation = 0, azimuth = 0;
};

// Position of the sun's centre: Meeus, "Astronomical Algorithms", chapters 7, 12, 13 and 25 (low accuracy: 0.01 degrees), without
// refraction, parallax, or the difference between dynamical and universal time.
SunPosition sun_position(double latitude_degrees, double longitude_degrees, int year, int month, int day, double utc_hours);
// Sun position of a sky, from its angles or its place and time.
SunPosition sun_position(const Sky& sky);

// Unit vector towards the sun: north is -Z, east +X.
Vec3d direction_of(const SunPosition& position);

} // namespace blush
