#include "io/gltf_textures.h"

#include "io/gltf_accessors.h"
#include "io/gltf_extras.h"
#include "io/gltf_numbering.h"
#include "io/gltf_uri.h"
#include "io/image_channels.h"
#include "io/image_io.h"

#include <fmt/format.h>
#include <optional>
#include <tbb/parallel_for.h>

namespace blush {
namespace {

std::string image_name(const tinygltf::Image& image, size_t index) {
    if (!image.uri.empty()) return percent_decoded(image.uri);
    return image.name.empty() ? fmt::format("images[{}]", index) : image.name;
}

// Decoded images, null where nothing can be shown. Only those that a texture names are decoded.
Result<std::vector<ImagePtr>> decode_images(const GltfContext& context) {
    const tinygltf::Model& model = context.model();
    std::vector<std::optional<Result<ImagePtr>>> decoded(model.images.size());
    std::vector<std::span<const uint8_t>> encoded(model.images.size());
    for (const tinygltf::Texture& texture : model.textures) {
        if (texture.source < 0 || size_t(texture.source) >= model.images.size()) continue; // reported with the texture
        const auto bytes = encoded_image(context, size_t(texture.source));
        if (!bytes) return bytes.error();
        encoded[size_t(texture.source)] = *bytes;
    }
    tbb::parallel_for(size_t(0), encoded.size(), [&](size_t i) {
        if (!encoded[i].empty() && !context.cancelled()) decoded[i] = read_image(encoded[i], image_name(model.images[i], i));
    });
    if (context.cancelled()) return context.cancel_error();

    std::vector<ImagePtr> images(model.images.size());
    for (size_t i = 0; i < images.size(); ++i) {
        if (decoded[i] && *decoded[i])
            images[i] = with_color_channels(**decoded[i]);
        else if (decoded[i])
            context.warn(decoded[i]->error().what + ": " + image_name(model.images[i], i), fmt::format("images[{}]", i));
    }
    return images;
}

Texture::Wrap wrap_mode(const GltfContext& context, int mode, const std::string& where) {
    switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE: return Texture::Wrap::clamp_to_edge;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT: return Texture::Wrap::mirrored_repeat;
    case TINYGLTF_TEXTURE_WRAP_REPEAT: return Texture::Wrap::repeat;
    default: context.warn(fmt::format("unknown wrap mode {}; repeat is used", mode), where); return Texture::Wrap::repeat;
    }
}

Result<void> apply_sampler(const GltfContext& context, int index, Texture& texture, const std::string& where) {
    if (index < 0) return {};
    const auto& samplers = context.model().samplers;
    if (size_t(index) >= samplers.size())
        return context.error(fmt::format("sampler {} does not exist; there are {}", index, samplers.size()), where);
    const tinygltf::Sampler& sampler = samplers[size_t(index)];
    const std::string sampler_where = fmt::format("samplers[{}]", index);
    texture.wrap_u = wrap_mode(context, sampler.wrapS, sampler_where);
    texture.wrap_v = wrap_mode(context, sampler.wrapT, sampler_where);
    if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) texture.filter = Texture::Filter::nearest;
    return {};
}

// All but its image; none if there is nothing that can be shown.
Result<std::optional<Texture>> read_texture(const GltfContext& context, size_t index) {
    const tinygltf::Texture& source = context.model().textures[index];
    const std::vector<tinygltf::Image>& images = context.model().images;
    const std::string where = fmt::format("textures[{}]", index);
    if (source.source < 0) {
        context.warn("a texture without an image in PNG or JPEG is not shown", where);
        return std::optional<Texture>();
    }
    if (size_t(source.source) >= images.size())
        return context.error(fmt::format("image {} does not exist; there are {}", source.source, images.size()), where);
    const tinygltf::Image& image = images[size_t(source.source)];
    if (image.bufferView < 0 && image.image.empty()) context.warn("missing image " + image_name(image, size_t(source.source)), where);
    Texture texture;
    texture.name = !source.name.empty() ? source.name : image_name(image, size_t(source.source));
    texture.source = image.uri.empty() ? "embedded" : percent_decoded(image.uri);
    if (const auto ok = apply_sampler(context, source.sampler, texture, where); !ok) return ok.error();
    read_extras(context, gltf_item(context.json(), "textures", index), texture, where);
    return std::optional(std::move(texture));
}

} // namespace

Result<std::span<const uint8_t>> encoded_image(const GltfContext& context, size_t index) {
    const tinygltf::Image& image = context.model().images[index];
    if (image.bufferView >= 0) return buffer_view_bytes(context, image.bufferView, fmt::format("images[{}]", index));
    return std::span<const uint8_t>(image.image);
}

Result<std::vector<Id<Texture>>> import_textures(const GltfContext& context, Scene& scene) {
    const tinygltf::Model& model = context.model();
    const Result<std::vector<ImagePtr>> images = context.known ? std::vector<ImagePtr>(model.images.size()) : decode_images(context);
    if (!images) return images.error();
    std::vector<std::optional<Texture>> textures(model.textures.size());
    std::vector<uint32_t> wanted(textures.size());
    const auto known = context.known ? ids_by_index(context.known->textures, textures.size()) : std::vector<Id<Texture>>(textures.size());
    for (size_t i = 0; i < textures.size(); ++i) {
        Result<std::optional<Texture>> texture = read_texture(context, i);
        if (!texture) return texture.error();
        if (*texture) (*texture)->image = (*images)[size_t(model.textures[i].source)];
        if (!*texture || (!(*texture)->image && !known[i])) continue;
        textures[i] = **std::move(texture);
        wanted[i] = wanted_id(gltf_item(context.json(), "textures", i));
    }
    return add_numbered(scene.textures, std::move(textures), wanted);
}

} // namespace blush
