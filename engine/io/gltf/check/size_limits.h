// Internal to io/gltf: size limits. Rejects files whose decoded size is implausibly large for their number of bytes.
#pragma once

#include "io/gltf/read/context.h"

#include <vector>

namespace blush {

// Primitives and animations may share bytes, and accessors may have none, so that a small file could need any amount of memory.
// Errors: the meshes of `nodes`, animations and skins need more memory than plausible for the size of the file.
Result<void> check_size_limits(const GltfContext& context, const std::vector<int>& nodes);

// Decoded size of a primitive's attributes as floats, in bytes; unreadable ones count 0.
double decoded_bytes(const GltfContext& context, const tinygltf::Primitive& primitive);

} // namespace blush
