// Internal to gltf_*.cpp: a parsed document to a scene.
#pragma once

#include "io/gltf_source.h"

namespace blush {

// Fills in everything but the origin's file and text. Errors as import_gltf's.
Result<void> convert_gltf(const GltfContext& context, ImportedScene& imported);

} // namespace blush
