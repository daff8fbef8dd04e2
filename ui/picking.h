// What a frame says about the place under the mouse: the planes answer, no ray is traced.
#pragma once

#include "render/frame.h"
#include "ui/projection.h"

#include <optional>

namespace blush {

struct Picked {
    Id<Node> node;
    Id<Material> material;
    std::optional<double> depth; // metres along the ray
};

// Nothing where the frame holds no such plane or the camera's ray hit nothing. (u, v) is in the picture, (0, 0) top left.
Picked pick(const Frame& frame, double u, double v);
struct SurfaceSpot {
    Vec3d position{0, 0, 0};
    Vec3d normal{0, 0, 1}; // for shading, unit length
    Id<Node> node;
};
// The surface that is seen at (u, v); nothing where the frame has no depth or no normal there.
std::optional<SurfaceSpot> seen_surface(const Frame& frame, const Projection& projection, double u, double v);
// The point of a surface that is seen at (u, v).
std::optional<Vec3d> seen_point(const Frame& frame, const Projection& projection, double u, double v);

} // namespace blush
