// Handles in the viewport that move, rotate, scale and aim the selected node: the maths, without drawing. World units are metres;
// the screen is the viewport in pixels, y down.
#pragma once

#include "scene/scene.h"
#include "ui/projection.h"

#include <array>
#include <optional>
#include <vector>

namespace blush {

struct ScreenPoint {
    float x = 0, y = 0;
};

// Where the picture lies on the screen.
struct ImageRect {
    float x = 0, y = 0, width = 1, height = 1;
    ScreenPoint at(const ImagePoint& p) const { return {x + float(p.u) * width, y + float(p.v) * height}; }
    double u(float screen_x) const { return (screen_x - x) / width; }
    double v(float screen_y) const { return (screen_y - y) / height; }
    bool contains(float screen_x, float screen_y) const {
        return screen_x >= x && screen_x < x + width && screen_y >= y && screen_y < y + height;
    }
};

// What is done to the selection; also which gizmo is shown.
enum class TransformMode { grab, rotate, scale };

enum class Handle {
    none, move, move_x, move_y, move_z, aim,
    rotate, rotate_x, rotate_y, rotate_z, // rotate: about the line of sight
    scale, scale_x, scale_y, scale_z,     // scale: in all directions
    width, height, radius, outer_cone, inner_cone, spread, sun_angle
};

// It changes a light's size or cone.
constexpr bool is_size(Handle handle) { return handle >= Handle::width; }
// It belongs to the gizmo of that mode.
bool is_of_gizmo(Handle handle, TransformMode mode);
// 0, 1, 2 for a gizmo's handle of X, Y, Z; -1: it is of none.
int axis_of(Handle handle);

// A handle as it lies on the screen: a line from the centre to its grip, or the part of a ring that faces the eye.
struct HandleShape {
    Handle handle = Handle::none;
    ScreenPoint from, grip;
    std::vector<ScreenPoint> ring = {};
};

// Which gizmo, where and how large.
struct GizmoPlace {
    TransformMode mode = TransformMode::grab;
    Vec3d position;
    std::array<Vec3d, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; // orthonormal
    float size = 80;            // pixels: of axes and rings; the ring about the line of sight is larger
    bool along_axes = true;     // false: the one handle that knows no axis alone
};

// The handles of a gizmo, and one to aim with, where `aim_at` is given. Axis handles are `size` pixels long on the screen at most. Handles
// behind the eye, or axes that point at it, are left out.
std::vector<HandleShape> handle_shapes(const Projection& projection, const ImageRect& image, const GizmoPlace& place,
                                       const std::optional<Vec3d>& aim_at);
// The handle under the mouse, within `reach` pixels; grips win over lines.
Handle handle_under(const std::vector<HandleShape>& shapes, ScreenPoint mouse, float reach);

// Where the ray meets the plane through `point`; nothing when parallel or behind.
std::optional<Vec3d> meet_plane(const ViewRay& ray, const Vec3d& point, const Vec3d& normal);
// Parameter t of the point origin + t * axis that is nearest to the ray; nothing when they are parallel.
std::optional<double> nearest_on_axis(const ViewRay& ray, const Vec3d& origin, const Vec3d& axis);
// Radians, right-handed about the unit axis, of the place where the ray meets the plane of a ring around `centre`, from some fixed start;
// nothing where the ring is seen edge-on or the ray misses its plane.
std::optional<double> ring_angle(const ViewRay& ray, const Vec3d& centre, const Vec3d& axis);
// Radians that a ring seen edge-on is turned by pulling its near side over the screen, `radius` pixels being its radius.
double pulled_angle(const Projection& projection, const Vec3d& centre, const Vec3d& axis, ScreenPoint from, ScreenPoint to, float radius);

// The node's transform after moving its origin to a world position, its rotation and scale untouched.
Transform moved_to(const Scene& scene, Id<Node> node, const Vec3d& world_position);
// The node's transform after putting its origin at a world position and turning it in the world, its scale untouched.
Transform placed_at(const Scene& scene, Id<Node> node, const Vec3d& world_position, const Quat& world_rotation);
// The node's transform after turning it in the world, its origin and scale untouched.
Transform rotated_to(const Scene& scene, Id<Node> node, const Quat& world_rotation);
// The rotation of a node in the world, scale taken out.
Quat world_rotation(const Scene& scene, Id<Node> node);

} // namespace blush
