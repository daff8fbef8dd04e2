// Internal to io/gltf: converts a parsed document to a scene.
#pragma once

#include "io/gltf/read/context.h"

namespace blush {

// Sets everything except the file and text of the origin. Errors: as of import_gltf.
Result<void> convert_gltf(const GltfContext& context, ImportedScene& imported);

} // namespace blush
