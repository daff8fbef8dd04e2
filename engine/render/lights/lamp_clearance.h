// Clearance boxes: shadow rays that end before an emissive mesh.
//
// A triangle on the convex hull of its mesh (hull_triangles.h) is not hidden by the mesh from any point in front of it. If nothing else is
// near the mesh, nothing at all can block a shadow ray to the triangle within a box around the mesh: the ray may end where it enters the
// box, so that it spares the BVH of the mesh, which takes most of the time of shadow rays to meshes of many triangles. The image stays
// the same, but for rays that rounding let graze the mesh.
#pragma once

#include "core/parallel.h"
#include "render/bvh/accel.h"
#include "render/compile/geometry_pool.h"
#include "render/lights/mesh_lights.h"

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace blush {

class LampClearances {
public:
    // Finds the emissive meshes with many triangles on their convex hull, except those of area lights, and numbers them in the records of
    // `lights`. Hulls of meshes of the last call are reused; deformed meshes are new ones. `objects` as passed to `geometry`. False if
    // the lamps and their places are those of the last call.
    bool find_lamps(const std::vector<SceneObject>& objects, const GeometryPool& geometry, MeshLights& lights, const Workers& workers);
    // Decides which of them stand clear of all other geometry in `accel`. `tables`: of `geometry`; `spheres`: those in `accel`.
    void find_clear_lamps(const Accel& accel, const GeometryPool& geometry, const SceneTables& tables,
                          const std::vector<AccelSphere>& spheres, const Workers& workers);

    // By number; null: no lamp stands clear. Valid until the next change.
    const ClearanceBox* boxes() const { return clear_lamps_ > 0 ? boxes_.data() : nullptr; }
    size_t lamps() const { return lamps_.size(); }
    size_t clear_lamps() const { return clear_lamps_; }

private:
    struct Lamp {
        int32_t part = 0;
        Vec3 low, high; // bounds of its triangles, world space
        bool operator==(const Lamp&) const = default;
    };
    struct Hull {
        std::vector<uint8_t> triangles; // as hull_triangles() returns them
        bool useful = false;            // they are enough for a clearance box to pay
    };
    using Hulls = std::map<uint64_t, std::shared_ptr<const Hull>>; // by serial of the mesh

    std::shared_ptr<const Hull> hull_of(const Geometry& mesh, Hulls& used, const Workers& workers) const;

    Hulls hulls_;
    std::vector<Lamp> lamps_;
    std::vector<ClearanceBox> boxes_; // by lamp
    size_t clear_lamps_ = 0;
};

// Meshes with fewer triangles are traced nearly as fast as they are missed.
constexpr int64_t min_triangles_of_a_lamp = 64;

} // namespace blush
