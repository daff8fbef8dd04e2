// Rays in double precision, one at a time, without a BVH: what stands between two points, and the surface under a click.
#pragma once

#include "scene/scene.h"

#include <array>
#include <functional>
#include <optional>

namespace blush {

// The visible object that the straight line from one point to another meets first, among those that `counts`; none where it meets nothing.
// What lets light through, as glass or by its alpha, is not met. A
// ten-thousandth of the line at either end is left out, which is where the surfaces are that it begins and ends on. Looks at every triangle of
// what the line may meet: milliseconds for a million.
std::optional<Id<Node>> first_between(const Scene& scene, const Vec3d& from, const Vec3d& to, const std::function<bool(Id<Node>)>& counts);
// The share of the line from `from` to `to` that is free of all of those: 1 where it meets nothing.
double free_share(const Scene& scene, const Vec3d& from, const Vec3d& to, const std::function<bool(Id<Node>)>& counts);

// Where a ray meets the surface of a visible object among those that `counts`, of any material, seen from either side.
struct RayHit {
    Id<Node> node;
    Vec3d position;
    Vec3d normal;    // of the plane, unit length, towards the ray's origin
    std::array<Vec3d, 3> corners; // of the triangle, in the world
    double largest_term; // metres: of the products that place its corners about their node
};
std::optional<RayHit> cast_ray(const Scene& scene, const Vec3d& origin, const Vec3d& direction, const std::function<bool(Id<Node>)>& counts);

} // namespace blush
