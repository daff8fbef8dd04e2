// Internal to gltf_*.cpp: skins.
#pragma once

#include "io/gltf_source.h"

#include <vector>

namespace blush {

// The ids that skins will have, by index: nodes name them before joints, which are nodes, have ids.
std::vector<Id<Skin>> number_skins(const GltfContext& context);

// Adds the skins under the ids in `indices`, which has the nodes as well. Of a document that is read without its buffers, joints are
// at rest where the mesh is. Errors: a joint or accessor out of range.
Result<void> import_skins(const GltfContext& context, const GltfIndices& indices, Scene& scene);

} // namespace blush
