// Internal to gltf_*.cpp: textures with their samplers.
#pragma once

#include "io/gltf_source.h"

#include <vector>

namespace blush {

// Adds the file's textures to the scene; result[i] is the id of glTF texture i, or none if its image is missing or cannot
// be decoded, which is a warning. Errors: an index out of range, cancelled.
Result<std::vector<Id<Texture>>> import_textures(const GltfContext& context, Scene& scene);

} // namespace blush
