// Internal to gltf_*.cpp: the pixels of a file's textures, decoded in parallel and within a limit of memory.
#pragma once

#include "io/gltf_source.h"

#include <span>
#include <string>
#include <vector>

namespace blush {

// The bytes of an image's file, none if that is missing. `index` must be that of an image. Errors: a buffer view that is none.
Result<std::span<const uint8_t>> encoded_image(const GltfContext& context, size_t index);
// Index of the image that a texture shows, as far as the file can be trusted; -1: none that can be decoded. EXT_texture_webp goes before the
// PNG or JPEG that stands in for it.
int texture_image(const GltfContext& context, size_t texture);
// What to call it in messages.
std::string image_name(const GltfContext& context, size_t index);

// By image those that are wanted, null where nothing can be shown, which is a warning; indices of no image are passed over. Files with the
// same bytes become one image. Where all would exceed ImportOptions::texture_bytes, the largest are halved until they do not, with a warning each. Grey images
// become RGB. Errors: a buffer view that is none, cancelled.
Result<std::vector<ImagePtr>> decode_images(const GltfContext& context, std::span<const int> wanted);

} // namespace blush
