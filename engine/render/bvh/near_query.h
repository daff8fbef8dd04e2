// Triangles near a point, by Embree's point queries.
#pragma once

#include "core/vec.h"

#include <cstdint>
#include <functional>

struct RTCSceneTy;

namespace blush {

// A triangle, numbered as a hit of it (HitArrays in accel.h).
struct NearTriangle {
    int32_t geometry, instance, triangle;
};
// Returns false to end the query.
using NearVisitor = std::function<bool(const NearTriangle&)>;

// Embree's scenes, and the numbers of what is in them (accel.cpp).
struct NearScenes {
    RTCSceneTy *top, *area_lights;                // area_lights: null if the top level holds them
    uint32_t first_area_light, area_light_meshes; // of area_lights
    uint32_t first_instance;                      // in the top level, after its meshes
};

// Calls `visit` for all triangles that come within `radius` of `center`, in any order, and for some that do not. Geometry with a ray mask
// of 0 is not visited, nor are spheres.
void visit_near(const NearScenes& scenes, const Vec3& center, float radius, const NearVisitor& visit);

} // namespace blush
