// Where a scene lies, and the origin about which it is rendered.
//
// Single precision steps by 0.06 at a million metres, and rays of a room built there would leak through its corners. So the
// tables hold positions relative to an origin near the geometry, subtracted in double precision before they are rounded.
#pragma once

#include "render/object_list.h"
#include "render/sphere_lights.h"
#include "scene/scene.h"

#include <cstdint>
#include <map>
#include <vector>

namespace blush {

struct Extent {
    Bounds bounds;         // world space: boxes around the boxes of the objects' parts, and the lights that are spheres
    Vec3d origin{0, 0, 0}; // what the tables call world space is the world's minus this
};

// The centre of the bounds, rounded to multiples of a power of two between four and eight times their radius: (0, 0, 0) for a scene
// that lies where scenes usually do, and mostly the same while an object is dragged about. No coordinate of the geometry is further
// from it than five radii.
Vec3d render_origin(const Bounds& bounds);

// Computes extents without looking at every vertex at every edit: the bounds of each payload are kept.
class ExtentCache {
public:
    Extent extent_of(const std::vector<SceneObject>& objects, const std::vector<SphereLight>& spheres);

private:
    std::map<uint64_t, Bounds> by_serial_; // object space
};

} // namespace blush
