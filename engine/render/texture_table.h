// The images that a scene's materials read, as texels in two pools: bytes and floats.
#pragma once

#include "core/result.h"
#include "scene/scene.h"
#include "shading/texture.h"

#include <cstdint>
#include <string>
#include <vector>

namespace blush {

class Workers;

// A texture as materials read it: one image may hold colour for one slot and data for another.
struct TextureSource {
    Id<Texture> id;
    bool is_color = false; // sRGB-encoded
    ImagePtr image;
    Texture::Wrap wrap_u = Texture::Wrap::repeat, wrap_v = Texture::Wrap::repeat;
    Texture::Filter filter = Texture::Filter::linear;
    std::string name; // for warnings
    bool operator==(const TextureSource&) const = default;
};

struct TextureTable {
    std::vector<TextureSource> sources; // one per record
    std::vector<TextureRecord> records;
    std::vector<TextureLevel> levels;
    std::vector<uint32_t> rgba8, rgba16f;
    std::vector<float> rgba32f;
    std::vector<Diagnostic> warnings;
    double seconds = 0; // that building it took

    // -1 if absent.
    int32_t index_of(Id<Texture> id, bool is_color) const;
    // Texels per unit of the image's own coordinates: the geometric mean of width and height.
    float texels_per_unit(int32_t texture) const;
    // Without uses. Valid until the table changes.
    TextureTables tables() const;
    size_t memory_bytes() const;
};

// Memory of an image's texels in the pools, smaller versions included.
int64_t texel_bytes(const Image& image);

// Sources are sorted by (id, is_color), without repetition. An image that several read is stored once. Grey images become
// RGB, missing alpha is 1. Float images count as sRGB-encoded where they are read as colour and stay within [0, 1], as 16-bit
// PNG does; a value above 1 marks linear data. With a warning: texels that are negative or not finite become 0, and images
// that do not hold what they say, or are beyond the pool's limits, become a white texel. Smaller versions hold the means of what is
// meant: of linear colour, in half precision where the image has 8 bits. `workers`: share the work; null: none.
TextureTable build_texture_table(std::vector<TextureSource> sources, const Workers* workers = nullptr);

} // namespace blush
