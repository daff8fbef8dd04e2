// Internal to gltf_*.cpp: meshes; nodes that share a glTF mesh share ours.
#pragma once

#include "io/gltf_source.h"

#include <vector>

namespace blush {

// By glTF mesh: its id, none if unused, and which of its primitives its parts are.
struct ImportedMeshes {
    std::vector<Id<Mesh>> ids;
    std::vector<std::vector<int>> primitives;
};

// Adds the meshes that `nodes` use, converted side by side. Reports progress from 0.3 to 0.6. Errors: as import_primitive, a material
// out of range, cancelled.
Result<ImportedMeshes> import_meshes(const GltfContext& context, const std::vector<int>& nodes, const std::vector<Id<Material>>& materials,
                                     Scene& scene);

} // namespace blush
