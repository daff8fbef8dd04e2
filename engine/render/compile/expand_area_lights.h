// Expands area lights into emissive meshes, which is all that the kernels handle.
#pragma once

#include "render/compile/deformed_meshes.h"
#include "render/compile/tangent_meshes.h"
#include "scene/scene.h"

#include <utility>
#include <vector>

namespace blush {

// A table with the records that expansion adds. If neither the table nor the records changed, returns the table of the last call, which
// shares storage with its copies: comparing two expanded scenes then does not read it.
template <class T> class ExtendedTable {
public:
    using Records = std::vector<typename Table<T>::Entry>;

    Table<T> extended(const Table<T>& table, Records more) {
        if (table.shares_storage(table_) && more == more_) return extended_;
        table_ = extended_ = table;
        for (const auto& [id, value] : more) extended_.insert(id, value);
        more_ = std::move(more);
        return extended_;
    }

private:
    Table<T> table_, extended_;
    Records more_;
};

// Cache of what expansion made last time.
struct ExpandedMeshes {
    TangentMeshes tangents;
    DeformedMeshes deformed;
    ExtendedTable<Node> nodes;
    ExtendedTable<Mesh> meshes;
    ExtendedTable<Material> materials;
};

// Returns the scene with solo (light_visibility.h) and its pose (posed_scene.h) applied and every rectangle and disk light
// replaced by an emissive mesh below its node (expanded_lights.h). A disk becomes a polygon of the same area with disk_corners()
// corners (light_limits.h). With max_disk_corners, area sampling is identical and the flux differs from the circle's by less than
// a millionth, and kernels need no special case. The mesh of a disabled light is black (is_disabled_mesh). Meshes that need tangents
// get them (tangent_meshes.h), and deforming meshes are deformed (deformed_meshes.h). `known` caches meshes and tables between
// calls. `workers` share the deformation of large meshes, which does not change the result.
Scene expand_area_lights(const Scene& scene, ExpandedMeshes* known = nullptr, const Workers* workers = nullptr);

} // namespace blush
