// Handles in the viewport that move, rotate, scale and aim the selected node: only the maths, no drawing. World units are metres;
// screen coordinates are viewport pixels, y down.
#pragma once

#include "scene/scene.h"
#include "ui/viewport/projection.h"

#include <array>
#include <optional>
#include <vector>

namespace blush {

struct ScreenPoint {
    float x = 0, y = 0;
};

// Rectangle of the image on the screen.
struct ImageRect {
    float x = 0, y = 0, width = 1, height = 1;
    ScreenPoint at(const ImagePoint& p) const { return {x + float(p.u) * width, y + float(p.v) * height}; }
    double u(float screen_x) const { return (screen_x - x) / width; }
    double v(float screen_y) const { return (screen_y - y) / height; }
    bool contains(float screen_x, float screen_y) const {
        return screen_x >= x && screen_x < x + width && screen_y >= y && screen_y < y + height;
    }
};

// The transform applied to the selection; also selects the displayed gizmo.
enum class TransformMode { grab, rotate, scale };

enum class Handle {
    none,
    move,
    move_x,
    move_y,
    move_z,
    aim,
    rotate,
    rotate_x,
    rotate_y,
    rotate_z, // rotate: about the view direction
    scale,
    scale_x,
    scale_y,
    scale_z, // scale: uniform
    width,
    height,
    radius,
    outer_cone,
    inner_cone,
    spread,
    sun_angle
};

// True for handles that change a light's size or cone.
constexpr bool is_size(Handle handle) { return handle >= Handle::width; }
// True if the handle belongs to the gizmo of that mode.
bool is_of_gizmo(Handle handle, TransformMode mode);
// 0, 1, 2 for a gizmo's X, Y or Z handle; -1 for others.
int axis_of(Handle handle);

// The screen shape of a handle: a line from the centre to its grip, or the part of a ring that faces the viewer.
struct HandleShape {
    Handle handle = Handle::none;
    ScreenPoint from, grip;
    std::vector<ScreenPoint> ring = {};
};

// Mode, position and size of a gizmo.
struct GizmoPlace {
    TransformMode mode = TransformMode::grab;
    Vec3d position;
    std::array<Vec3d, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; // orthonormal
    float size = 80;        // pixels, length of axes and radius of rings; the ring about the view direction is larger
    bool along_axes = true; // false: only the handle without an axis
};

// The handles of a gizmo, plus an aim handle if `aim_at` is given. Axis handles are at most `size` pixels long on the screen.
// Handles behind the viewer, and axes that point at the viewer, are left out.
std::vector<HandleShape> handle_shapes(const Projection& projection, const ImageRect& image, const GizmoPlace& place,
                                       const std::optional<Vec3d>& aim_at);
// The handle under the mouse, within `reach` pixels; grips have priority over lines.
Handle handle_under(const std::vector<HandleShape>& shapes, ScreenPoint mouse, float reach);

// Intersection of the ray with the plane through `point`; nullopt if parallel or behind.
std::optional<Vec3d> meet_plane(const ViewRay& ray, const Vec3d& point, const Vec3d& normal);
// Parameter t of the point origin + t * axis that is closest to the ray; nullopt if they are parallel.
std::optional<double> nearest_on_axis(const ViewRay& ray, const Vec3d& origin, const Vec3d& axis);
// Angle about the unit axis `axis`, in radians, right-handed, of the ray's intersection with the plane of a ring around `centre`,
// from a fixed start; nullopt if the ring is seen edge-on or the ray misses its plane.
std::optional<double> ring_angle(const ViewRay& ray, const Vec3d& centre, const Vec3d& axis);
// Radians of rotation when the near side of an edge-on ring is dragged over the screen; the ring's radius is `radius` pixels.
double edge_on_ring_angle(const Projection& projection, const Vec3d& centre, const Vec3d& axis, ScreenPoint from, ScreenPoint to,
                          float radius);

// The node's transform with its origin moved to a world position; rotation and scale unchanged.
Transform moved_to(const Scene& scene, Id<Node> node, const Vec3d& world_position);
// The node's transform with its origin moved to a world position and rotated in the world; scale unchanged.
Transform placed_at(const Scene& scene, Id<Node> node, const Vec3d& world_position, const Quat& world_rotation);
// The node's transform rotated in the world; origin and scale unchanged.
Transform rotated_to(const Scene& scene, Id<Node> node, const Quat& world_rotation);
// The world rotation of a node, without scale.
Quat world_rotation(const Scene& scene, Id<Node> node);

} // namespace blush
