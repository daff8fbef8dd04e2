// Internal to gltf_*.cpp: meshes; nodes that share a glTF mesh share ours.
#pragma once

#include "io/gltf_source.h"

#include <vector>

namespace blush {

// Adds the meshes that `nodes` use; result[i] is the id of glTF mesh i, none if unused. Reports progress from 0.6 to 1.
// Errors: as import_primitive, a material out of range, cancelled.
Result<std::vector<Id<Mesh>>> import_meshes(const GltfContext& context, const std::vector<int>& nodes,
                                            const std::vector<Id<Material>>& materials, Scene& scene);

} // namespace blush
