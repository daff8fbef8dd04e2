// Object, material and surface point under the mouse, read from a frame's AOVs; no rays are traced.
#pragma once

#include "render/frame.h"
#include "ui/viewport/projection.h"

#include <optional>

namespace blush {

struct Picked {
    Id<Node> node;
    Id<Material> material;
    std::optional<double> depth; // metres along the ray
};

// nullopt if the frame has no such plane or nothing was hit. (u, v) is in the image, (0, 0) top left.
Picked pick(const Frame& frame, double u, double v);
struct SurfacePoint {
    Vec3d position{0, 0, 0};
    Vec3d normal{0, 0, 1}; // shading normal, unit length
    Id<Node> node;
};
// The visible surface at (u, v); nullopt if the frame has no depth or no normal there.
std::optional<SurfacePoint> surface_at_pixel(const Frame& frame, const Projection& projection, double u, double v);
// The visible surface point at (u, v).
std::optional<Vec3d> seen_point(const Frame& frame, const Projection& projection, double u, double v);

} // namespace blush
