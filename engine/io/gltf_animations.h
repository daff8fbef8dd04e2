// Internal to gltf_*.cpp: animations of nodes.
#pragma once

#include "io/gltf_source.h"

#include <vector>

namespace blush {

// Adds a clip for each animation; result[i] is that of animations[i]. Channels whose keyframes make no sense, or of nodes that are not
// shown, are left out, with a warning where the file is to blame. Of a document that is read without its buffers the clips are empty.
std::vector<Id<Clip>> import_animations(const GltfContext& context, const GltfIndices& indices, Scene& scene);

} // namespace blush
