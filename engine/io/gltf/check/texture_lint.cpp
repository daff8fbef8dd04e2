#include "core/math.h"
#include "io/gltf/check/lint.h"
#include "io/gltf/read/images/images.h"
#include "scene/texture_slots.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <map>
#include <set>

namespace blush {
namespace {

bool holds_color(const TextureSlot& slot) {
    return slot.name.find("colour") != slot.name.npos || slot.name.find("emissive") != slot.name.npos;
}
bool holds_normals(const TextureSlot& slot) { return slot.name.find("normal") != slot.name.npos; }

// True for a PNG with an `sRGB` chunk.
bool is_marked_srgb(std::span<const uint8_t> png) {
    constexpr uint8_t signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    if (png.size() < sizeof signature || std::memcmp(png.data(), signature, sizeof signature) != 0) return false;
    for (size_t at = sizeof signature; at + 12 <= png.size();) {
        const uint64_t length = uint64_t(png[at]) << 24 | uint64_t(png[at + 1]) << 16 | uint64_t(png[at + 2]) << 8 | png[at + 3];
        const std::string_view name(reinterpret_cast<const char*>(png.data()) + at + 4, 4);
        if (name == "sRGB") return true;
        if (name == "IDAT" || length > png.size() - at - 12) return false;
        at += 12 + size_t(length);
    }
    return false;
}

// True if at least three quarters of the sampled pixels decode to vectors of about unit length with z > 0.
bool looks_like_normals(const Image& image) {
    if (image.channels < 3) return false;
    const size_t pixels = size_t(image.width) * size_t(image.height), step = std::max<size_t>(1, pixels / 4096);
    const auto value = [&](size_t pixel, size_t c) {
        const size_t i = pixel * size_t(image.channels) + c;
        return image.bytes.empty() ? double(image.floats[i]) : image.bytes[i] / 255.0;
    };
    size_t looked_at = 0, upright = 0;
    for (size_t pixel = 0; pixel < pixels; pixel += step) {
        const double x = 2 * value(pixel, 0) - 1, y = 2 * value(pixel, 1) - 1, z = 2 * value(pixel, 2) - 1;
        const double size = std::sqrt(x * x + y * y + z * z);
        upright += z > 0 && size > 0.7 && size < 1.3;
        ++looked_at;
    }
    return upright * 4 >= looked_at * 3;
}

struct Uses {
    std::set<std::string_view> as_color, as_data;
    bool as_normals = false;
};

// Uses of each glTF image.
std::map<int, Uses> uses_of(const GltfContext& context, const Scene& scene, const GltfIndices& indices) {
    std::map<int, Uses> uses;
    for (const auto& [id, material] : scene.materials)
        for (const TextureSlot& slot : texture_slots) {
            const auto texture = indices.textures.find((material.*slot.ref).texture);
            if (texture == indices.textures.end()) continue;
            Uses& u = uses[texture_image(context, size_t(texture->second))];
            (holds_color(slot) ? u.as_color : u.as_data).insert(slot.name);
            u.as_normals |= holds_normals(slot);
        }
    return uses;
}

const Image* image_of(const GltfContext& context, const Scene& scene, const GltfIndices& indices, int image) {
    for (const auto& [id, index] : indices.textures)
        if (texture_image(context, size_t(index)) == image)
            if (const Texture* texture = scene.textures.find(id); texture && texture->image) return texture->image.get();
    return nullptr;
}

} // namespace

void report_textures(const GltfContext& context, const Scene& scene, const GltfIndices& indices) {
    for (const auto& [image, uses] : uses_of(context, scene, indices)) {
        if (image < 0 || size_t(image) >= context.model().images.size()) continue;
        const std::string where = fmt::format("images[{}]", image);
        if (!uses.as_color.empty() && !uses.as_data.empty())
            context.warn(fmt::format("read as colour for a {} and as data for a {}: one of them is wrong", *uses.as_color.begin(),
                                     *uses.as_data.begin()),
                         where);
        const Image* pixels = uses.as_normals ? image_of(context, scene, indices, image) : nullptr;
        if (pixels && !looks_like_normals(*pixels)) context.warn("used as a normal map, but does not look like one", where);
        const auto bytes = encoded_image(context, size_t(image));
        if (uses.as_color.empty() && bytes && is_marked_srgb(*bytes))
            context.note(fmt::format("marked as sRGB, but a {} is data: glTF reads it without decoding", *uses.as_data.begin()), where);
    }
}

} // namespace blush
