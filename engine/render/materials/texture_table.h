// The textures that a scene's materials use.
#pragma once

#include "core/result.h"
#include "render/materials/image_texels.h"
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

struct TextureTable {
    std::vector<TextureSource> sources; // one per record
    std::vector<TextureRecord> records;
    std::vector<TextureLevel> levels;
    std::vector<ImageTexelsPtr> images; // hold the texels of the levels
    std::vector<Diagnostic> warnings;
    double seconds = 0; // build time

    // -1 if absent.
    int32_t index_of(Id<Texture> id, bool is_color) const;
    // Texels per unit of the image's own coordinates: the geometric mean of width and height.
    float texels_per_unit(int32_t texture) const;
    // Without texture uses. Valid until the table changes.
    TextureTables tables() const;
    // Without the images themselves, which belong to the scene.
    size_t memory_bytes() const;
};

// Sources are sorted by (id, is_color) and unique. An image with several users is stored once, and once more if it is both colour
// and data: then only its mip levels are. With a warning: invalid values (image_texels.h), and white for images with inconsistent
// data. Texels that `before` holds are taken over. `workers`: share the work; null: single-threaded.
TextureTable build_texture_table(std::vector<TextureSource> sources, TextureTable&& before = {}, const Workers* workers = nullptr);

} // namespace blush
