// Internal to gltf_*.cpp: which images textures show, and where their bytes are.
#pragma once

#include "io/gltf_source.h"

#include <span>
#include <string>

namespace blush {

// The bytes of an image's file, none if that is missing. `index` must be that of an image. Errors: a buffer view that is none.
Result<std::span<const uint8_t>> encoded_image(const GltfContext& context, size_t index);
// Index of the image that a texture shows, as far as the file can be trusted; -1: none that can be decoded. EXT_texture_webp goes before the
// PNG or JPEG that stands in for it.
int texture_image(const GltfContext& context, size_t texture);
// What to call it in messages.
std::string image_name(const GltfContext& context, size_t index);

} // namespace blush
