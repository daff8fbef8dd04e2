// Internal to io/gltf: imports skins.
#pragma once

#include "io/gltf/read/context.h"

#include <vector>

namespace blush {

// Assigns ids to skins by index, before import_skins: nodes need skin ids, and skins need node ids of their joints.
std::vector<Id<Skin>> assign_skin_ids(const GltfContext& context);

// Adds the skins with the ids in `indices`, which must hold the nodes as well. If the document is read without its buffers,
// inverse bind matrices are the identity. Errors: a joint or accessor out of range.
Result<void> import_skins(const GltfContext& context, const GltfIndices& indices, Scene& scene);

} // namespace blush
