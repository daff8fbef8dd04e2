// Internal to io/gltf: finds the image of a texture and its encoded bytes.
#pragma once

#include "io/gltf/read/context.h"

#include <span>
#include <string>

namespace blush {

// The encoded bytes of an image; empty if its file is missing. `index` must be valid. Errors: a buffer view that does not exist.
Result<std::span<const uint8_t>> encoded_image(const GltfContext& context, size_t index);
// Index of a texture's image (not range-checked); -1: none that can be decoded. Prefers EXT_texture_webp to the PNG or JPEG
// fallback.
int texture_image(const GltfContext& context, size_t texture);
// Path of an image in the JSON, for messages.
std::string image_path(size_t index);
// Name for messages.
std::string image_name(const GltfContext& context, size_t index);

} // namespace blush
