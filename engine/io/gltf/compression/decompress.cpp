#include "io/gltf/compression/decompress.h"

#include "io/gltf/compression/draco.h"
#include "io/gltf/compression/meshopt.h"
#include "io/gltf/read/context.h"

namespace blush {

Result<void> decompress(GltfSource& source, const ImportOptions& options, ImportReport& report) {
    const GltfContext context{source, options, report};
    DecompressionLimit room(source);
    if (const auto ok = decompress_meshopt(source, context, room); !ok) return ok;
    return decompress_draco(source, context, room);
}

} // namespace blush
