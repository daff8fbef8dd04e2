#include "io/gltf/read/images/images.h"

#include "io/gltf/read/geometry/accessors.h"
#include "io/gltf/read/object.h"
#include "io/gltf/read/uri.h"

#include <fmt/format.h>

namespace blush {
int texture_image(const GltfContext& context, size_t texture) {
    const tinygltf::Texture& source = context.model().textures[texture];
    const auto webp = source.extensions.find("EXT_texture_webp");
    if (webp == source.extensions.end()) return source.source;
    return GltfObject(context, webp->second, fmt::format("textures[{}].extensions.EXT_texture_webp", texture))
        .integer("source")
        .value_or(source.source);
}

std::string image_path(size_t index) { return fmt::format("images[{}]", index); }

std::string image_name(const GltfContext& context, size_t index) {
    const tinygltf::Image& image = context.model().images[index];
    if (is_data_uri(image.uri)) return image_path(index);
    if (!image.uri.empty()) return percent_decoded(image.uri);
    return image.name.empty() ? image_path(index) : image.name;
}

Result<std::span<const uint8_t>> encoded_image(const GltfContext& context, size_t index) {
    const tinygltf::Image& image = context.model().images[index];
    if (image.bufferView >= 0) return buffer_view_bytes(context, image.bufferView, image_path(index));
    return std::span<const uint8_t>(image.image);
}

} // namespace blush
