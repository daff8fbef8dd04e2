// The BVH: wraps Embree behind arrays; no file outside this folder includes it. Two levels: shared or large meshes are instanced, all other
// geometry is flattened into the top level, where it is traced fastest (an instance costs 3-5 % on every ray, a second level of
// small boxes 40 %) and is cheap to rebuild.
#pragma once

#include "core/parallel.h"
#include "render/bvh/accel_scene.h"
#include "render/bvh/near_query.h"
#include "render/bvh/ray_arrays.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace blush {

struct SmallScene;
struct SceneTables;

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

    // Number of triangles in meshes whose BVH stores indices to save memory (compact_bvh.h); each mesh counts once.
    size_t compact_triangles() const;
    size_t memory_bytes() const;

    // The whole scene if it is so small that kernels trace it without the BVH (brute_force.h); null: it is not. Valid until the next
    // commit.
    const SmallScene* small_scene() const;

    // By the BVH: closest hits and any-hits, in the widest packets that this machine
    // supports. `coherent`: rays share an origin region and direction. Blended surfaces stop rays by chance.
    void intersect(const RayArrays& rays, int count, bool coherent, const HitArrays& hits) const;
    // blocked[i] = 1 if anything lies within far_distance of ray i.
    void occluded(const RayArrays& rays, int count, bool coherent, uint8_t* blocked) const;

    // As intersect(), and share[i] of the light of the background passes along ray i: the product of the transmittances of all blended
    // surfaces on it, also those behind the one that stops it; 0 if it ends on anything else. Always by the BVH.
    void intersect_blended(const RayArrays& rays, int count, const HitArrays& hits, float* share) const;

    // For shadow rays in scenes with blended surfaces (SceneTables::blends), always by the BVH. At points that are neither opaque nor
    // clear, these rays are not stopped by chance:
    // share[i] of the light passes along ray i within far_distance: the product of the transmittances, 1 - opacity, of those points,
    // or 0 if the ray hits anything else. If rays.random is set, panes (material_pane) are met by chance, and small products end by
    // Russian roulette.
    void transmittance(const RayArrays& rays, int count, bool coherent, float* share) const;
    // Closest hits on anything else.
    void intersect_unblended(const RayArrays& rays, int count, bool coherent, const HitArrays& hits) const;
    // Visits the triangles near a point (near_query.h). `places` of the instances, as committed.
    void visit_near(const Vec3& center, float radius, const InstanceRecord* places, const NearVisitor& visit) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace blush
