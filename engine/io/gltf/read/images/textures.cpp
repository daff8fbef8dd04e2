#include "io/gltf/read/images/textures.h"

#include "io/gltf/read/extras.h"
#include "io/gltf/read/ids.h"
#include "io/gltf/read/images/images.h"
#include "io/gltf/read/object.h"
#include "io/gltf/read/uri.h"

#include <fmt/format.h>

#include <optional>
#include <set>
#include <string_view>

namespace blush {
namespace {

Texture::Wrap wrap_mode(const GltfContext& context, int mode, const std::string& where) {
    switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE: return Texture::Wrap::clamp_to_edge;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT: return Texture::Wrap::mirrored_repeat;
    case TINYGLTF_TEXTURE_WRAP_REPEAT: return Texture::Wrap::repeat;
    default: context.warn(fmt::format("unknown wrap mode {}; repeat is used", mode), where); return Texture::Wrap::repeat;
    }
}

// Name of a minification filter; "" for unknown values.
std::string_view minification_name(int filter) {
    switch (filter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST: return "NEAREST";
    case TINYGLTF_TEXTURE_FILTER_LINEAR: return "LINEAR";
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST: return "NEAREST_MIPMAP_NEAREST";
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST: return "LINEAR_MIPMAP_NEAREST";
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR: return "NEAREST_MIPMAP_LINEAR";
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR: return "LINEAR_MIPMAP_LINEAR";
    default: return "";
    }
}

// Minified textures are always averaged over the ray cone: other filters converge to the same mean, with more noise. No note if
// the file does not set a filter.
void report_filters(const GltfContext& context, const std::set<int>& samplers) {
    for (const int index : samplers) {
        const tinygltf::Sampler& sampler = context.model().samplers[size_t(index)];
        const std::string where = fmt::format("samplers[{}]", index);
        if (const std::string_view name = minification_name(sampler.minFilter); name.empty() && sampler.minFilter >= 0)
            context.warn(fmt::format("unknown minification filter {}; LINEAR_MIPMAP_LINEAR is used", sampler.minFilter), where);
        else if (!name.empty() && sampler.minFilter != TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR)
            context.note(
                fmt::format("approximated: minification filter {}: LINEAR_MIPMAP_LINEAR is used, over the footprint of the path", name),
                where);
        if (sampler.magFilter >= 0 && sampler.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST &&
            sampler.magFilter != TINYGLTF_TEXTURE_FILTER_LINEAR)
            context.warn(fmt::format("unknown magnification filter {}; LINEAR is used", sampler.magFilter), where);
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

// Image by texture, -1 for none.
std::vector<int> texture_images(const GltfContext& context) {
    std::vector<int> images(context.model().textures.size());
    for (size_t i = 0; i < images.size(); ++i) images[i] = texture_image(context, i);
    return images;
}

// The texture without its image; none if it is not supported.
Result<std::optional<Texture>> read_texture(const GltfContext& context, size_t index) {
    const tinygltf::Texture& source = context.model().textures[index];
    const std::vector<tinygltf::Image>& images = context.model().images;
    const std::string where = fmt::format("textures[{}]", index);
    const int image_index = texture_image(context, index);
    if (source.extensions.contains("KHR_texture_basisu"))
        context.warn(image_index < 0 ? "ignored: KTX2 cannot be decoded, and there is no PNG, JPEG or WebP fallback"
                                     : "approximated: KTX2 cannot be decoded; the fallback image is read",
                     where);
    else if (image_index < 0)
        context.warn("ignored: a texture without a PNG, JPEG or WebP image", where);
    if (image_index < 0) return std::optional<Texture>();
    if (size_t(image_index) >= images.size())
        return context.error(fmt::format("image {} does not exist; there are {}", image_index, images.size()), where);
    const tinygltf::Image& image = images[size_t(image_index)];
    const std::string name = image_name(context, size_t(image_index));
    if (image.bufferView < 0 && image.image.empty()) context.warn("missing image " + name, where);
    Texture texture;
    texture.name = !source.name.empty() ? source.name : name;
    texture.source = image.uri.empty() ? "embedded" : percent_decoded(image.uri);
    if (const auto ok = apply_sampler(context, source.sampler, texture, where); !ok) return ok.error();
    read_extras(context, gltf_item(context.json(), "textures", index), texture, where);
    return std::optional(std::move(texture));
}

} // namespace

Result<TextureImport> TextureImport::begin(const GltfContext& context) {
    const std::vector<int> images = texture_images(context);
    if (context.known) return read(context, images, std::nullopt);
    Result<ImageDecoding> decoding = ImageDecoding::begin(context, images);
    if (!decoding) return decoding.error();
    return read(context, images, *std::move(decoding));
}

Result<TextureImport> TextureImport::read(const GltfContext& context, std::vector<int> images, std::optional<ImageDecoding> decoding) {
    TextureImport read(std::move(images), std::move(decoding));
    const GltfContext own = context.reporting_to(read.report_);
    for (size_t i = 0; i < read.images_.size(); ++i) {
        Result<std::optional<Texture>> texture = read_texture(own, i);
        if (!texture) return texture.error();
        read.textures_.push_back(*std::move(texture));
        read.wanted_.push_back(requested_id(gltf_item(context.json(), "textures", i)));
    }
    if (context.known) read.known_ = ids_by_index(context.known->textures, read.images_.size());
    return read;
}

bool TextureImport::is_there(size_t index) const {
    if (!textures_[index]) return false;
    if (!decoding_) return bool(known_[index]);
    return finished_ ? decoding_->image(images_[index]) != nullptr : decoding_->is_expected(images_[index]);
}

std::vector<Id<Texture>> TextureImport::add_to(Scene& scene) const {
    std::vector<std::optional<Texture>> textures(textures_.size());
    for (size_t i = 0; i < textures.size(); ++i) {
        if (!is_there(i)) continue;
        textures[i] = textures_[i];
        if (decoding_) textures[i]->image = decoding_->image(images_[i]);
    }
    return add_with_ids(scene.textures, std::move(textures), wanted_);
}

bool TextureImport::is_done() const { return !decoding_ || decoding_->is_done(); }

Result<void> TextureImport::finish(const GltfContext& context, const std::function<void()>& on_more) {
    if (decoding_)
        if (const auto ok = decoding_->finish(on_more); !ok) return ok;
    context.add_all(report_.diagnostics);
    finished_ = true;
    std::set<int> samplers;
    for (size_t i = 0; i < textures_.size(); ++i)
        if (is_there(i) && context.model().textures[i].sampler >= 0) samplers.insert(context.model().textures[i].sampler);
    report_filters(context, samplers);
    return {};
}

} // namespace blush
