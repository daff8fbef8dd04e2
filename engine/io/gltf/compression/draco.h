// Internal to io/gltf: KHR_draco_mesh_compression. The only file that uses the Draco library.
#pragma once

#include "io/gltf/compression/decompression_limit.h"

namespace blush {

// Decompresses all primitives that have no uncompressed data, in parallel: each becomes a triangle list whose accessors point to
// buffers added to `source`. Primitives whose accessors have bytes use those. `context` must belong to `source`. Reports progress
// from 0.1 to 0.3. Errors: a buffer view out of range, data that is not a Draco mesh of bitstream 2.2, a missing attribute, a
// mesh larger than its bytes can describe, more than `room` allows, cancelled.
Result<void> decompress_draco(GltfSource& source, const GltfContext& context, DecompressionLimit& room);

} // namespace blush
