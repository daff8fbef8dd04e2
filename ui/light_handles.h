// Handles that change a light's size: where they are, and what dragging them does. Pure.
#pragma once

#include "ui/gizmo.h"

namespace blush {

// The light of a node as it lies before the eye.
struct LightSight {
    Light light;
    Affined world_from_node;
    Quat rotation; // in the world, without scale
    double reach;  // metres of the lines that show its cone, as light_outline draws them
    double em;     // metres that a letter of the screen's text spans at the light
};

struct SizeHandle {
    Handle handle;
    Vec3d grip; // in the world
};
// Those that the kind of light has. A radius of 0 can be grabbed as well: its handle keeps clear of the centre.
std::vector<SizeHandle> size_handles(const LightSight& sight, const Projection& projection);

// The light after a size handle was dragged from one ray to another. Sizes stay positive, a radius of a point or spot not negative, the
// inner cone within the outer one. The radiance stays, or the flux where the light asks for that.
Light resized(const LightSight& start, Handle handle, const Projection& projection, const ViewRay& from, const ViewRay& to);

// A sun's angle on a dial around its glyph: the dial's radius in ems, steeper where angles are small. The two are each other's inverse.
double dial_of_angle(double radians);
double angle_of_dial(double ems); // 0 .. pi

// The angle to the axis at which a cone of `length` metres from `apex` is under the mouse; nothing where the ray misses what it is read
// from.
std::optional<double> cone_angle_under(const ViewRay& ray, const Vec3d& apex, const Vec3d& axis, const Projection& projection,
                                       double length);

} // namespace blush
