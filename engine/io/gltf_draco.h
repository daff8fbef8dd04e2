// Internal to gltf_*.cpp: KHR_draco_mesh_compression. The only room that knows the Draco library.
#pragma once

#include "io/gltf_source.h"

namespace blush {

// Unpacks every primitive that comes in compressed form only: its accessors then have bytes, in buffers added to `source`, and it is a list
// of triangles. One whose accessors have bytes of their own is read from those. `context` is of the same source.
// Errors: a buffer view out of range, bytes that are no Draco mesh of bitstream 2.2, an attribute that is not in it, a mesh larger than
// its bytes can describe.
Result<void> unpack_draco(GltfSource& source, const GltfContext& context);

} // namespace blush
