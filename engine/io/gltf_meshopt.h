// Internal to gltf_*.cpp: EXT_meshopt_compression. The only room that knows the meshoptimizer library.
#pragma once

#include "io/gltf_unpacked.h"

namespace blush {

// Unpacks every compressed buffer view, side by side: it then lies in a buffer added to `source`. `context` is of the same source. Reports
// progress up to 0.1.
// Errors: a buffer, a range or a stride that is not as the extension demands, bytes that cannot be decoded or describe more than they can,
// more than there is room for, cancelled.
Result<void> unpack_meshopt(GltfSource& source, const GltfContext& context, UnpackingRoom& room);

} // namespace blush
