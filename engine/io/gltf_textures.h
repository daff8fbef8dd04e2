// Internal to gltf_*.cpp: images decoded in parallel, textures with their samplers.
#pragma once

#include "io/gltf_source.h"

#include <span>
#include <vector>

namespace blush {

// The bytes of an image's file, none if that is missing. `index` must be that of an image. Errors: a buffer view that is none.
Result<std::span<const uint8_t>> encoded_image(const GltfContext& context, size_t index);

// Adds the file's textures to the scene; result[i] is the id of glTF texture i, or none if its image is missing or cannot
// be decoded, which is a warning. Errors: an index out of range, cancelled.
Result<std::vector<Id<Texture>>> import_textures(const GltfContext& context, Scene& scene);

} // namespace blush
