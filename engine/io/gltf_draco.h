// Internal to gltf_*.cpp: KHR_draco_mesh_compression. The only room that knows the Draco library.
#pragma once

#include "io/gltf_unpacked.h"

namespace blush {

// Unpacks every primitive that comes in compressed form only, side by side: its accessors then have bytes, in buffers added to `source`,
// and it is a list of triangles. One whose accessors have bytes of their own is read from those. `context` is of the same source. Reports
// progress from 0.1 to 0.3. Errors: a buffer view out of range, bytes that are no Draco mesh of bitstream 2.2, an attribute that is not in
// it, a mesh larger than its bytes can describe, more than there is room for, cancelled.
Result<void> unpack_draco(GltfSource& source, const GltfContext& context, UnpackingRoom& room);

} // namespace blush
