// Triangles near a point, by Embree's point queries.
#pragma once

#include "core/vec.h"

#include <cstdint>
#include <functional>
#include <span>

struct RTCSceneTy;

namespace blush {

struct InstanceRecord;

// A triangle, numbered as a hit of it (HitArrays in accel.h).
struct NearTriangle {
    int32_t geometry, instance, triangle;
};
// Returns false to end the query.
using NearVisitor = std::function<bool(const NearTriangle&)>;

// The next `count` instances, which share a mesh.
struct MeshInstances {
    RTCSceneTy* mesh;
    size_t count;
};

// Embree's scenes, and the numbers of what is in them (accel.cpp).
struct NearScenes {
    RTCSceneTy *top, *area_lights;                // area_lights: null if the top level holds them
    uint32_t first_area_light, area_light_meshes; // of area_lights
    uint32_t flat_meshes;                         // in the top level
    std::span<const MeshInstances> instances;
    const InstanceRecord* places; // by instance
};

// Calls `visit` for all triangles that come within `radius` of `center`, in any order, and for some that do not. Flat meshes with a ray
// mask of 0 are not visited, nor are spheres. Takes time for each instance.
void visit_near(const NearScenes& scenes, const Vec3& center, float radius, const NearVisitor& visit);

} // namespace blush
