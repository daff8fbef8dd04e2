// What rays can hit: the input of the BVH (accel.h) and of the brute-force tracer (small_scene.h).
#pragma once

#include "core/vec.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace blush {

struct InstanceRecord;

// A ray can hit an object if their masks share a bit. The other bits are
// for shadow rays of lights with linked shadow casters (light_links.h).
constexpr uint32_t camera_ray_mask = 1, other_ray_mask = 2;
constexpr uint32_t seen_by_all = ~0u;

// Triangles as input of the BVH builder. Arrays that have an owner are shared, and kept alive while they are traced; others are
// copied. Shared positions must be readable for 16 bytes each, including the last one.
struct AccelTriangles {
    uint64_t serial = 0; // of the Geometry payload: key of the bottom-level BVH
    std::shared_ptr<const void> owner = nullptr;
    const Vec3* positions = nullptr;
    size_t vertex_count = 0;
    const uint32_t* indices = nullptr; // 3 per triangle
    size_t triangle_count = 0;
    int32_t part = 0;            // the part whose material and attributes give the opacity
    bool alpha = false;          // hits are tested against the material's opacity
    uint32_t mask = seen_by_all; // used for flat geometry only; 0: not in the BVH
};
struct AccelInstances {
    std::vector<AccelTriangles> geometries; // one mesh
    std::span<const InstanceRecord> places; // one instance at each; all transforms are invertible (baked_transforms.h)
    uint32_t mask = seen_by_all;
};
struct AccelSphere {
    Vec3 center;
    float radius = 0;
    uint32_t mask = seen_by_all;
};
struct AccelScene {
    std::vector<AccelTriangles> flat;      // world space; Embree's geometry id is the index
    std::vector<AccelInstances> instances; // numbered consecutively
    std::vector<AccelSphere> spheres;      // world space
    size_t first_area_light = size_t(-1);  // flat[first_area_light] and the following are meshes of area lights
    uint64_t memory_left = 0;              // bytes, for tests; 0: read from the system
};

} // namespace blush
