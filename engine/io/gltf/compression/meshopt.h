// Internal to io/gltf: EXT_meshopt_compression. The only file that uses the meshoptimizer library.
#pragma once

#include "io/gltf/compression/decompression_limit.h"

namespace blush {

// Decompresses all compressed buffer views in parallel, into buffers added to `source`. `context` must belong to `source`.
// Reports progress up to 0.1. Errors: a buffer, range or stride that violates the extension, bytes that cannot be decoded, a size
// beyond what the bytes can describe or `room` allows, cancelled.
Result<void> decompress_meshopt(GltfSource& source, const GltfContext& context, DecompressionLimit& room);

} // namespace blush
