// Internal to io/gltf: imports meshes. Nodes that share a glTF mesh share the Mesh.
#pragma once

#include "io/gltf/read/context.h"

#include <vector>

namespace blush {

// By glTF mesh: its id (none if unused), and the primitive index of each part.
struct ImportedMeshes {
    std::vector<Id<Mesh>> ids;
    std::vector<std::vector<int>> primitives;
};

// Adds the meshes that `nodes` use, converted in parallel. Reports progress from 0.3 to 0.6. Errors: as of import_primitive, a
// material out of range, cancelled.
Result<ImportedMeshes> import_meshes(const GltfContext& context, const std::vector<int>& nodes, const std::vector<Id<Material>>& materials,
                                     Scene& scene);

} // namespace blush
