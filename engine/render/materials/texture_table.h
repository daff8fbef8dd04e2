// The textures that a scene's materials use, as texels in two pools: bytes and floats.
#pragma once

#include "core/result.h"
#include "scene/scene.h"
#include "shading/texture.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace blush {

class Workers;

// An image as used by a material slot: one image may be colour for one slot and data for another.
struct TextureSource {
    Id<Texture> id;
    bool is_color = false; // sRGB-encoded
    ImagePtr image;
    Texture::Wrap wrap_u = Texture::Wrap::repeat, wrap_v = Texture::Wrap::repeat;
    Texture::Filter filter = Texture::Filter::linear;
    std::string name; // for warnings
    bool operator==(const TextureSource&) const = default;
};

// Leaves new elements unset, for arrays that several threads fill.
template <class T> struct UnsetAllocator : std::allocator<T> {
    template <class U> struct rebind { using other = UnsetAllocator<U>; };
    template <class U, class... Args> void construct(U* p, Args&&... args) {
        if constexpr (sizeof...(Args) > 0) std::construct_at(p, std::forward<Args>(args)...);
    }
};

struct TextureTable {
    std::vector<TextureSource> sources; // one per record
    std::vector<TextureRecord> records;
    std::vector<TextureLevel> levels;
    std::vector<uint32_t, UnsetAllocator<uint32_t>> rgba8, rgba16f;
    std::vector<float, UnsetAllocator<float>> rgba32f;
    std::vector<Diagnostic> warnings;
    double seconds = 0; // build time

    // -1 if absent.
    int32_t index_of(Id<Texture> id, bool is_color) const;
    // Texels per unit of the image's own coordinates: the geometric mean of width and height.
    float texels_per_unit(int32_t texture) const;
    // Without texture uses. Valid until the table changes.
    TextureTables tables() const;
    size_t memory_bytes() const;
};

// Memory of an image's texels in the pools, including mip levels.
int64_t texel_bytes(const Image& image);

// Sources are sorted by (id, is_color) and unique. An image with several users is stored once. Grey images become RGB, missing
// alpha is 1. Float images used as colour count as sRGB-encoded if they stay within [0, 1], as in 16-bit PNG; a value above 1
// marks linear data. With a warning: negative or non-finite texels become 0, and images with inconsistent data or beyond the pool
// limits become a white texel. Mip levels are averaged in linear colour, and stored in half precision for 8-bit images.
// `workers`: share the work; null: single-threaded.
TextureTable build_texture_table(std::vector<TextureSource> sources, const Workers* workers = nullptr);

} // namespace blush
