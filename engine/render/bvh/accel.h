// The BVH: wraps Embree behind arrays; no file outside this folder includes it. Two levels: shared or large meshes are instanced, all other
// geometry is flattened into the top level, where it is traced fastest (an instance costs 3-5 % on every ray, a second level of
// small boxes 40 %) and is cheap to rebuild.
#pragma once

#include "core/parallel.h"
#include "render/bvh/accel_scene.h"
#include "render/bvh/near_query.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace blush {

struct SmallScene;
struct SceneTables;

// Instance index of a hit on a sphere; the sphere's index is stored as the triangle index.
constexpr int32_t sphere_instance = -2;

// Rays and hits as arrays of `count`; arrays are readable up to the next multiple of 16.
struct RayArrays {
    const float *ox, *oy, *oz, *dx, *dy, *dz;
    const float* far_distance; // null: infinite
    const uint32_t* random;    // per-ray random number for stochastic opacity; read only if has_alpha()
    uint32_t mask = other_ray_mask;
    const uint32_t* masks = nullptr; // per ray; replaces `mask` if set
};
struct HitArrays {
    float *t, *u, *v;  // t in units of the direction's length; u, v: weights of vertices 1 and 2
    int32_t* geometry; // -1: miss
    int32_t* instance; // index among the instances, -1: hit in the flat part, or sphere_instance
    int32_t* triangle;
};

class Accel {
public:
    Accel();
    ~Accel();
    Accel(const Accel&) = delete;
    Accel& operator=(const Accel&) = delete;

    // In scenes with this many instances, area lights (meshes and spheres) get a BVH of their own, so that moving one does not
    // rebuild the large top level. With fewer instances, a second traversal costs more than it saves.
    static constexpr size_t min_instances_for_area_light_bvh = 4096;

    // Builds the top level for `scene` and the missing bottom levels; frees unused ones. `tables` is read by the opacity test
    // while tracing. Throws std::runtime_error if Embree fails (out of memory).
    void commit(const AccelScene& scene, const SceneTables* tables, const Workers& workers);
    // True if area lights have a BVH of their own.
    bool has_area_light_bvh() const;
    // Builds only that BVH: for as many meshes of area lights as committed last time, and any spheres. Throws like commit().
    void commit_area_lights(std::span<const AccelTriangles> meshes, std::span<const AccelSphere> spheres, const SceneTables* tables,
                            const Workers& workers);

    bool has_alpha() const;
    // Number of triangles in meshes whose BVH stores indices to save memory (compact_bvh.h); each mesh counts once.
    size_t compact_triangles() const;
    size_t memory_bytes() const;

    // The whole scene if it is so small that kernels trace it without the BVH (brute_force.h); null: it is not. Valid until the next
    // commit.
    const SmallScene* small_scene() const;

    // By the BVH: closest hits and any-hits, in the widest packets that this machine
    // supports. `coherent`: rays share an origin region and direction.
    void intersect(const RayArrays& rays, int count, bool coherent, const HitArrays& hits) const;
    // blocked[i] = 1 if anything lies within far_distance of ray i.
    void occluded(const RayArrays& rays, int count, bool coherent, uint8_t* blocked) const;
    // Visits the triangles near a point (near_query.h). `places` of the instances, as committed.
    void visit_near(const Vec3& center, float radius, const InstanceRecord* places, const NearVisitor& visit) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace blush
