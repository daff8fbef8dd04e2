// Internal to the import: decompresses the parsed model, so that its accessors read like those of an uncompressed file. The JSON
// of the document is unchanged, so that saving keeps the compressed data.
#pragma once

#include "io/gltf/read/import_options.h"
#include "io/gltf/read/import_report.h"
#include "io/gltf/read/source.h"

namespace blush {

// Decompresses KHR_draco_mesh_compression and EXT_meshopt_compression.
Result<void> decompress(GltfSource& source, const ImportOptions& options, ImportReport& report);

} // namespace blush
