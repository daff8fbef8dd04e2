#include "io/gltf_images.h"

#include "core/box_filter.h"
#include "io/gltf_accessors.h"
#include "io/gltf_extras.h"
#include "io/gltf_object.h"
#include "io/gltf_uri.h"
#include "io/image_channels.h"
#include "io/image_io.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>
#include <queue>
#include <set>
#include <string_view>
#include <thread>
#include <unordered_map>

namespace blush {
namespace {

// One file's worth of bytes, whichever images of the glTF file it is.
struct Encoded {
    std::vector<size_t> images;
    std::span<const uint8_t> bytes;
    bool is_color = false;
    ImageInfo info;
    int halvings = 0;
    std::optional<Result<ImagePtr>> decoded;
};

constexpr std::array color_slots = {"baseColorTexture", "emissiveTexture", "specularColorTexture", "sheenColorTexture",
                                    "diffuseTransmissionColorTexture", "diffuseTexture", "specularGlossinessTexture"};

// The textures that a material's object reads as sRGB-encoded colour.
void add_color_textures(const nlohmann::json& object, std::set<int>& textures) {
    if (!object.is_object()) return;
    for (const char* slot : color_slots) {
        const auto info = object.find(slot);
        if (info == object.end() || !info->is_object()) continue;
        if (const auto index = info->find("index"); index != info->end() && index->is_number_integer()) textures.insert(index->get<int>());
    }
}

std::set<int> color_images(const GltfContext& context) {
    std::set<int> textures, images;
    for (size_t i = 0; i < context.model().materials.size(); ++i) {
        const nlohmann::json& material = gltf_item(context.json(), "materials", i);
        add_color_textures(material, textures);
        if (const auto pbr = material.find("pbrMetallicRoughness"); pbr != material.end()) add_color_textures(*pbr, textures);
        if (const auto extensions = material.find("extensions"); extensions != material.end() && extensions->is_object())
            for (const nlohmann::json& extension : *extensions) add_color_textures(extension, textures);
    }
    for (const int i : textures)
        if (i >= 0 && size_t(i) < context.model().textures.size()) images.insert(texture_image(context, size_t(i)));
    return images;
}

std::string where(size_t image) { return fmt::format("images[{}]", image); }

// Those that are there, each once.
Result<std::vector<Encoded>> encoded_images(const GltfContext& context, std::span<const int> wanted) {
    const std::set<int> images(wanted.begin(), wanted.end()), colors = color_images(context);
    const auto count = int64_t(context.model().images.size());
    std::vector<Encoded> files;
    std::unordered_map<std::string_view, size_t> known;
    for (const int i : images) {
        if (i < 0 || i >= count) continue; // reported with the texture
        const auto bytes = encoded_image(context, size_t(i));
        if (!bytes) return bytes.error();
        if (bytes->empty()) continue; // reported with the texture
        const auto [file, is_new] = known.try_emplace({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, files.size());
        if (is_new) files.push_back({{}, *bytes, false, {}, 0, {}});
        files[file->second].images.push_back(size_t(i));
        files[file->second].is_color |= colors.contains(i);
    }
    return files;
}

// What the file says about an image's format, empty if nothing: its MIME type, else the ending of its name.
std::string declared_format(const tinygltf::Image& image) {
    if (image.mimeType.starts_with("image/")) return image.mimeType.substr(6);
    const std::string ending = is_data_uri(image.uri) ? "" : std::filesystem::path(percent_decoded(image.uri)).extension().string();
    if (ending == ".jpg") return "jpeg";
    return ending.empty() ? "" : ending.substr(1);
}

void report_wrong_formats(const GltfContext& context, const std::vector<Encoded>& files) {
    constexpr std::array formats{"png", "jpeg", "webp"};
    for (const Encoded& file : files)
        for (const size_t i : file.images) {
            const std::string declared = declared_format(context.model().images[i]);
            if (file.info.format.empty() || declared == file.info.format || std::ranges::find(formats, declared) == formats.end()) continue;
            context.warn(fmt::format("said to be {} but is {}: read as what it is", declared, file.info.format), where(i));
        }
}

// Halves the largest until all fit.
void fit_into_memory(const GltfContext& context, std::vector<Encoded>& files) {
    const auto smaller = [](const Encoded* a, const Encoded* b) { return a->info.bytes(a->halvings) < b->info.bytes(b->halvings); };
    std::priority_queue<Encoded*, std::vector<Encoded*>, decltype(smaller)> largest(smaller);
    int64_t total = 0;
    for (Encoded& file : files) {
        total += file.info.bytes();
        largest.push(&file);
    }
    while (total > context.options.texture_bytes && !largest.empty()) {
        Encoded& file = *largest.top();
        largest.pop();
        const int64_t before = file.info.bytes(file.halvings), after = file.info.bytes(file.halvings + 1);
        if (after == before) continue; // a single pixel
        ++file.halvings;
        total += after - before;
        largest.push(&file);
    }
    for (const Encoded& file : files)
        if (file.halvings > 0)
            context.warn(fmt::format("reduced {} times, from {} x {} to {} x {} pixels, so that all textures fit into {} MiB: {}", file.halvings,
                                     file.info.width, file.info.height, halved(file.info.width, file.halvings),
                                     halved(file.info.height, file.halvings), context.options.texture_bytes >> 20,
                                     image_name(context, file.images[0])),
                         where(file.images[0]));
}

void decode(const GltfContext& context, Encoded& file) {
    const std::string name = image_name(context, file.images[0]);
    // More than 8 bits are encoded colour in a PNG and linear elsewhere.
    const bool is_srgb = file.is_color && (!file.info.is_float || file.info.format == "png");
    Result<ImagePtr> image = file.halvings == 0 ? read_image(file.bytes, name) : read_smaller_image(file.bytes, name, file.halvings, is_srgb);
    if (image) image = with_color_channels(*image);
    file.decoded = std::move(image);
}

// Small ones side by side, large ones one after the other, as decoders may need as much memory again.
void decode_all(const GltfContext& context, std::vector<Encoded>& files) {
    constexpr int64_t large = int64_t(1) << 28; // bytes
    const std::thread::id reporter = std::this_thread::get_id();
    std::atomic<size_t> done = 0;
    const auto decode_one = [&](Encoded& file) {
        if (!context.cancelled() && !file.decoded) decode(context, file);
        const size_t n = ++done;
        if (std::this_thread::get_id() == reporter)
            context.progress(0.3 + 0.3 * double(n) / double(files.size()), fmt::format("textures, {} of {}", n, files.size()));
    };
    std::vector<Encoded*> small;
    for (Encoded& file : files)
        if (file.info.bytes() <= large) small.push_back(&file);
    tbb::parallel_for(size_t(0), small.size(), [&](size_t i) { decode_one(*small[i]); }, tbb::simple_partitioner());
    for (Encoded& file : files)
        if (file.info.bytes() > large) decode_one(file);
}

} // namespace

int texture_image(const GltfContext& context, size_t texture) {
    const tinygltf::Texture& source = context.model().textures[texture];
    const auto webp = source.extensions.find("EXT_texture_webp");
    if (webp == source.extensions.end()) return source.source;
    return GltfObject(context, webp->second, fmt::format("textures[{}].extensions.EXT_texture_webp", texture)).integer("source").value_or(source.source);
}

std::string image_name(const GltfContext& context, size_t index) {
    const tinygltf::Image& image = context.model().images[index];
    if (is_data_uri(image.uri)) return where(index);
    if (!image.uri.empty()) return percent_decoded(image.uri);
    return image.name.empty() ? where(index) : image.name;
}

Result<std::span<const uint8_t>> encoded_image(const GltfContext& context, size_t index) {
    const tinygltf::Image& image = context.model().images[index];
    if (image.bufferView >= 0) return buffer_view_bytes(context, image.bufferView, where(index));
    return std::span<const uint8_t>(image.image);
}

Result<std::vector<ImagePtr>> decode_images(const GltfContext& context, std::span<const int> wanted) {
    Result<std::vector<Encoded>> files = encoded_images(context, wanted);
    if (!files) return files.error();
    for (Encoded& file : *files) {
        const Result<ImageInfo> info = read_image_info(file.bytes, image_name(context, file.images[0]));
        if (info) file.info = *info;
        else file.decoded = info.error();
        if (file.info.channels < 3) file.info.channels += 2; // with_color_channels
    }
    report_wrong_formats(context, *files);
    fit_into_memory(context, *files);
    decode_all(context, *files);
    if (context.cancelled()) return context.cancel_error();

    std::vector<ImagePtr> images(context.model().images.size());
    for (const Encoded& file : *files) {
        if (!*file.decoded) {
            for (const size_t i : file.images)
                context.warn(file.decoded->error().what + ": " + image_name(context, i), where(i));
            continue;
        }
        for (const size_t i : file.images) images[i] = **file.decoded;
    }
    return images;
}

} // namespace blush
