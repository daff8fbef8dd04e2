// World bounds of a scene, and the origin relative to which it is rendered.
//
// Single precision has steps of 0.06 at a million metres; rays of a room there would leak through its corners. So the tables
// store positions relative to an origin near the geometry, subtracted in double precision before rounding.
#pragma once

#include "render/compile/object_list.h"
#include "render/lights/sphere_lights.h"
#include "scene/scene.h"

#include <cstdint>
#include <map>
#include <vector>

namespace blush {

struct Extent {
    Bounds bounds;         // world space: union of the boxes of the objects' parts and of sphere lights
    Vec3d origin{0, 0, 0}; // tables use world positions minus this
};

// The centre of the bounds, rounded to multiples of a power of two between four and eight
// times their radius. (0, 0, 0) for scenes near the origin, and mostly constant while an
// object is dragged. No coordinate of the geometry is further from it than five radii.
Vec3d render_origin(const Bounds& bounds);

// Computes extents without reading all vertices at each edit: caches the bounds of each geometry.
class ExtentCache {
public:
    Extent extent_of(const std::vector<SceneObject>& objects, const std::vector<SphereLight>& spheres);
    // The same if only meshes of area lights and spheres moved since the last extent_of(): reads no other object.
    Extent with_moved_area_lights(const std::vector<SceneObject>& objects, const std::vector<SphereLight>& spheres) const;

private:
    void include(const SceneObject& object, Bounds& bounds) const;

    std::map<uint64_t, Bounds> by_serial_; // object space
    Bounds without_area_lights_;           // world space
    std::vector<size_t> area_lights_;      // indices of objects that are meshes of area lights
};

} // namespace blush
