// Internal to gltf_*.cpp: EXT_meshopt_compression. The only room that knows the meshoptimizer library.
#pragma once

#include "io/gltf_source.h"

namespace blush {

// Unpacks every compressed buffer view: it then lies in a buffer added to `source`. `context` is of the same source.
// Errors: a buffer, a range or a stride that is not as the extension demands, bytes that cannot be decoded or describe more than they can.
Result<void> unpack_meshopt(GltfSource& source, const GltfContext& context);

} // namespace blush
