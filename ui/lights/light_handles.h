// Handles that change a light's size: their positions, and the result of a drag. Pure.
#pragma once

#include "ui/transform/gizmo.h"

namespace blush {

// The light of a node, with its world pose as seen by the viewer.
struct LightInView {
    Light light;
    Affined world_from_node;
    Quat rotation; // in the world, without scale
    double reach;  // length of the lines that show its cone in metres, as in light_outline
    double em;     // metres per font size of the screen at the light's distance
};

struct SizeHandle {
    Handle handle;
    Vec3d grip; // in the world
};
// The handles of this type of light. A radius of 0 also has a handle, at a minimum distance from the centre.
std::vector<SizeHandle> size_handles(const LightInView& sight, const Projection& projection);

// The light after a size handle is dragged from one ray to another. Sizes stay positive, the radius of a point or spot
// non-negative, the inner cone within the outer cone. Radiance is preserved, or flux if the light's keep_power is set.
Light resized(const LightInView& start, Handle handle, const Projection& projection, const ViewRay& from, const ViewRay& to);

// Maps a sun's angle to a dial around its glyph: the dial's radius in font sizes, with finer resolution at small angles. The two
// functions are inverses.
double dial_of_angle(double radians);
double angle_of_dial(double ems); // 0 .. pi

// The cone angle under the mouse, for a cone of `length` metres from `apex`; nullopt if the ray misses the surface on which it is
// measured.
std::optional<double> cone_angle_under(const ViewRay& ray, const Vec3d& apex, const Vec3d& axis, const Projection& projection,
                                       double length);

} // namespace blush
