// Single ray casts in double precision without a BVH: occlusion between two points, picking, and the surface next to a point.
#pragma once

#include "scene/scene.h"

#include <array>
#include <functional>
#include <optional>

namespace blush {

// The first visible object on the straight line from one point to another for which `counts` is true; none if there is none.
// Objects that transmit light by transmission or alpha are ignored. A ten-thousandth of the line at either end is left out, since
// the line usually begins and ends on surfaces. Tests every triangle whose bounding box the line meets: milliseconds for a
// million.
std::optional<Id<Node>> first_occluder(const Scene& scene, const Vec3d& from, const Vec3d& to, const std::function<bool(Id<Node>)>& counts);
// Fraction of the line from `from` to `to` before its first such object: 1 if there is none.
double unoccluded_fraction(const Scene& scene, const Vec3d& from, const Vec3d& to, const std::function<bool(Id<Node>)>& counts);

// First hit of a ray with a visible object for which `counts` is true, of any material, from either side.
struct RayHit {
    Id<Node> node;
    Vec3d position;
    Vec3d normal;                 // geometric normal, unit length, on the side of the ray's origin
    std::array<Vec3d, 3> corners; // of the triangle, world space
    double largest_term;          // metres: largest term of the products that transform the corners; bounds the rounding error
};
std::optional<RayHit> cast_ray(const Scene& scene, const Vec3d& origin, const Vec3d& direction,
                               const std::function<bool(Id<Node>)>& counts);

// The point of a visible surface nearest to `point`, of any material, with the normal on the side of `viewer`.
std::optional<RayHit> nearest_surface(const Scene& scene, const Vec3d& point, const Vec3d& viewer);

} // namespace blush
