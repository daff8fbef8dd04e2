// Handles in the viewport that move and aim the selected node: the maths, without drawing. World units are metres;
// the screen is the viewport in pixels, y down.
#pragma once

#include "scene/scene.h"
#include "ui/projection.h"

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

enum class Handle { none, move, move_x, move_y, move_z, aim, width, height, radius, outer_cone, inner_cone, spread, sun_angle };

// It changes a light's size or cone.
constexpr bool is_size(Handle handle) { return handle >= Handle::width; }

// A handle as it lies on the screen: a line from the centre to its grip.
struct HandleShape {
    Handle handle = Handle::none;
    ScreenPoint from, grip;
};

// The handles of a node at `position`; `aim_at` is given for what has a direction. Axis handles are `size` pixels long on the
// screen at most. Handles behind the eye, or axes that point at it, are left out.
std::vector<HandleShape> handle_shapes(const Projection& projection, const ImageRect& image, const Vec3d& position,
                                       const std::optional<Vec3d>& aim_at, float size);
// The handle under the mouse, within `reach` pixels; grips win over lines.
Handle handle_under(const std::vector<HandleShape>& shapes, ScreenPoint mouse, float reach);

// Unit axis of an axis handle.
Vec3d axis_of(Handle handle);
// Where the ray meets the plane through `point`; nothing when parallel or behind.
std::optional<Vec3d> meet_plane(const ViewRay& ray, const Vec3d& point, const Vec3d& normal);
// Parameter t of the point origin + t * axis that is nearest to the ray; nothing when they are parallel.
std::optional<double> nearest_on_axis(const ViewRay& ray, const Vec3d& origin, const Vec3d& axis);

// The new world position of a node dragged by a move handle from where the mouse went down to where it is now.
Vec3d dragged_position(Handle handle, const Projection& projection, const ViewRay& start, const ViewRay& now, const Vec3d& position);

// The node's transform after moving its origin to a world position, its rotation and scale untouched.
Transform moved_to(const Scene& scene, Id<Node> node, const Vec3d& world_position);
// The node's transform after putting its origin at a world position and turning it in the world, its scale untouched.
Transform placed_at(const Scene& scene, Id<Node> node, const Vec3d& world_position, const Quat& world_rotation);
// The node's transform after turning it in the world, its origin and scale untouched.
Transform rotated_to(const Scene& scene, Id<Node> node, const Quat& world_rotation);
// The rotation of a node in the world, scale taken out.
Quat world_rotation(const Scene& scene, Id<Node> node);

} // namespace blush
