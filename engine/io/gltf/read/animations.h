// Internal to io/gltf: imports animations.
#pragma once

#include "io/gltf/read/context.h"

#include <vector>

namespace blush {

// Adds a clip for each animation; result[i] is the id of animations[i]. Skips channels with invalid keyframes (with a warning)
// and channels of nodes outside all scenes. Clips are empty if the document is read without its buffers.
std::vector<Id<Clip>> import_animations(const GltfContext& context, const GltfIndices& indices, Scene& scene);

} // namespace blush
