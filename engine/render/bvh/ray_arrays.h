// Rays and their hits as arrays.
#pragma once

#include "render/bvh/accel_scene.h"

#include <cstdint>

namespace blush {

// Instance index of a hit on a sphere; the sphere's index is stored as the triangle index.
constexpr int32_t sphere_instance = -2;

// Rays and hits as arrays of `count`; arrays are readable up to the next multiple of 16.
struct RayArrays {
    const float *ox, *oy, *oz, *dx, *dy, *dz;
    const float* far_distance; // null: infinite
    const uint32_t* random;    // per-ray random number for what is met by chance; may be null if the scene has no blended surfaces
    uint32_t mask = other_ray_mask;
    const uint32_t* masks = nullptr; // per ray; replaces `mask` if set
    const uint32_t* index = nullptr; // per ray: rays of one `random` and other indices are stratified at each blended triangle; null: 0
};
struct HitArrays {
    float *t, *u, *v;  // t in units of the direction's length; u, v: weights of vertices 1 and 2
    int32_t* geometry; // -1: miss
    int32_t* instance; // index among the instances, -1: hit in the flat part, or sphere_instance
    int32_t* triangle;
};

} // namespace blush
