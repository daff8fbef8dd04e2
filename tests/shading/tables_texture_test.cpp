// Texture lookups against a naive double-precision model, and the table that holds the texels.
#include "render/materials/material_table.h"
#include "scene/texture_slots.h"
#include "tests/shading/tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace blush::TEST_FILE {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();

// A scene with one material whose base colour and metallic-roughness slots read the same texture: as colour, as data.
struct Textured {
    Scene scene;
    Id<Texture> texture;
    MaterialTable table;

    Textured(const Texture& t, const TextureRef& ref) {
        texture = scene.textures.add(t);
        Material material;
        material.base_color_texture = material.metallic_roughness_texture = ref;
        material.base_color_texture.texture = material.metallic_roughness_texture.texture = texture;
        add_used_material(scene, material);
        build_material_table(table, scene);
    }
    Vec4 read(bool as_color, Vec2 uv0, Vec2 uv1 = {0, 0}) const {
        const MaterialRecord& r = table.records[1];
        return lookup<float>(table.tables().textures, as_color ? r.base_color_texture : r.metallic_roughness_texture, {{{uv0, uv1}}}, true);
    }
};

double decoded(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

struct Rgba {
    double c[4];
};

Rgba model_texel(const Image& image, bool as_color, int x, int y) {
    const size_t at = (size_t(y) * size_t(image.width) + size_t(x)) * size_t(image.channels);
    const auto channel = [&](int c) {
        return image.bytes.empty() ? double(image.floats[at + size_t(c)]) : image.bytes[at + size_t(c)] / 255.0;
    };
    const bool grey = image.channels < 3;
    Rgba t{{channel(0), channel(grey ? 0 : 1), channel(grey ? 0 : 2), image.channels % 2 == 0 ? channel(image.channels - 1) : 1.0}};
    if (as_color) {
        for (int c = 0; c < 3; ++c) t.c[c] = decoded(t.c[c]);
    }
    return t;
}

int model_wrap(int64_t i, int size, Texture::Wrap wrap) {
    const auto modulo = [](int64_t a, int64_t n) { return ((a % n) + n) % n; };
    if (wrap == Texture::Wrap::repeat) return int(modulo(i, size));
    if (wrap == Texture::Wrap::clamp_to_edge) return int(std::min<int64_t>(std::max<int64_t>(i, 0), size - 1));
    const int64_t j = modulo(i, 2 * size);
    return int(j < size ? j : 2 * size - 1 - j);
}

struct ModelPoint {
    double s, t;  // transformed coordinates
    double error; // bound on what float arithmetic may have made of each
};

ModelPoint model_transform(const TextureRef& ref, Vec2 uv) {
    const double c = std::cos(double(ref.rotation_radians)), s = std::sin(double(ref.rotation_radians));
    const double x = double(ref.scale.x) * uv.x, y = double(ref.scale.y) * uv.y;
    const double size = std::abs(x) + std::abs(y) + std::abs(ref.offset.x) + std::abs(ref.offset.y) + 1;
    return {c * x + s * y + ref.offset.x, -s * x + c * y + ref.offset.y, 8 * size * 0x1p-24};
}

Rgba model_lookup(const Texture& texture, bool as_color, const ModelPoint& p) {
    const Image& image = *texture.image;
    const bool nearest = texture.filter == Texture::Filter::nearest;
    const double x = p.s * image.width - (nearest ? 0 : 0.5), y = p.t * image.height - (nearest ? 0 : 0.5);
    const double fx = nearest ? 0 : x - std::floor(x), fy = nearest ? 0 : y - std::floor(y);
    Rgba sum{};
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            const double weight = (i ? fx : 1 - fx) * (j ? fy : 1 - fy);
            const Rgba t = model_texel(image, as_color, model_wrap(int64_t(std::floor(x)) + i, image.width, texture.wrap_u),
                                       model_wrap(int64_t(std::floor(y)) + j, image.height, texture.wrap_v));
            for (int c = 0; c < 4; ++c) sum.c[c] += weight * t.c[c];
        }
    }
    return sum;
}

double distance_to_integer(double x) { return std::abs(x - std::round(x)); }

Texture random_texture(Random& random) {
    Texture texture;
    const int width = 1 + random.below(9), height = 1 + random.below(9), channels = 1 + random.below(4);
    texture.image = random.coin() ? make_byte_image(width, height, channels, [&] { return uint8_t(random.below(256)); })
                                  : make_float_image(width, height, channels, [&] { return random.unit(); });
    texture.wrap_u = Texture::Wrap(random.below(3));
    texture.wrap_v = Texture::Wrap(random.below(3));
    texture.filter = Texture::Filter(random.below(2));
    return texture;
}

} // namespace

TEST(TextureLookup, AgreesWithADoublePrecisionModel) {
    Random random(1);
    for (int trial = 0; trial < 400; ++trial) {
        const Texture texture = random_texture(random);
        TextureRef ref;
        ref.uv_set = uint8_t(random.below(2));
        if (random.coin()) {
            ref.offset = {random.between(-2, 2), random.between(-2, 2)};
            ref.scale = {random.between(-3, 3), random.between(-3, 3)};
            ref.rotation_radians = random.between(-7, 7);
        }
        const Textured textured(texture, ref);
        for (int k = 0; k < 100; ++k) {
            const Vec2 uv{random.between(-4, 4), random.between(-4, 4)}, other{random.between(-4, 4), random.between(-4, 4)};
            const bool as_color = random.coin();
            const ModelPoint p = model_transform(ref, uv);
            const double dx = p.error * texture.image->width, dy = p.error * texture.image->height;
            // Nearest jumps at texel borders: no answer is wrong there.
            if (texture.filter == Texture::Filter::nearest &&
                (distance_to_integer(p.s * texture.image->width) < dx || distance_to_integer(p.t * texture.image->height) < dy)) {
                continue;
            }
            const Rgba expected = model_lookup(texture, as_color, p);
            const Vec4 got = textured.read(as_color, uv, other); // the only set that is read is the first, whatever its number
            const float channels[4] = {got.x, got.y, got.z, got.w};
            // Values lie in [0, 1]: one texel to the side changes them by at most 1.
            for (int c = 0; c < 4; ++c)
                ASSERT_NEAR(channels[c], expected.c[c], dx + dy + 8 * 0x1p-24) << "trial " << trial << " channel " << c;
        }
    }
}

TEST(TextureLookup, TexelCentresReadUnmixed) {
    int next = 0;
    Texture texture;
    texture.image = make_byte_image(8, 4, 3, [&] { return uint8_t(next++ * 2); });
    const Textured textured(texture, {});
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) {
            const Vec4 c = textured.read(false, {(float(x) + 0.5f) / 8, (float(y) + 0.5f) / 4});
            EXPECT_FLOAT_EQ(c.x, float((y * 8 + x) * 6) / 255.f);
        }
    }
}

TEST(TextureLookup, FiltersLinearLightNotEncodedValues) {
    Texture texture;
    int next = 0;
    texture.image = make_byte_image(2, 1, 1, [&] { return uint8_t(next++ * 255); });
    EXPECT_FLOAT_EQ(Textured(texture, {}).read(true, {0.5f, 0.5f}).x, 0.5f);
}

TEST(TextureLookup, ByteEndsAreExact) {
    Texture texture;
    int next = 0;
    texture.image = make_byte_image(2, 1, 1, [&] { return uint8_t(next++ * 255); });
    texture.filter = Texture::Filter::nearest;
    const Textured textured(texture, {});
    for (const bool as_color : {false, true}) {
        EXPECT_EQ(textured.read(as_color, {0.25f, 0.5f}), (Vec4{0, 0, 0, 1}));
        EXPECT_EQ(textured.read(as_color, {0.75f, 0.5f}), (Vec4{1, 1, 1, 1}));
    }
}

// A material whose textures lie on the sets of these numbers, in the order of texture_slots.
Material on_uv_sets(Id<Texture> texture, const std::vector<int>& sets) {
    Material m;
    m.specular = m.transmission = 0.5f;
    m.emissive = {1, 1, 1};
    for (size_t i = 0; i < sets.size(); ++i) {
        TextureRef& ref = m.*texture_slots[i].ref;
        ref.texture = texture;
        ref.uv_set = uint8_t(sets[i]);
    }
    return m;
}

TEST(TextureLookup, EachUseLiesOnItsOwnUvSet) {
    Scene scene;
    Texture ramp;
    int next = 0;
    ramp.image = make_byte_image(8, 1, 1, [&] { return uint8_t(next++ * 30); });
    const std::vector<int> sets{4, 0, 255, 2, 9, 5, 1};
    add_used_material(scene, on_uv_sets(scene.textures.add(ramp), sets));
    MaterialTable table;
    build_material_table(table, scene);
    EXPECT_EQ(table.uv_sets, (std::vector<int>{0, 1, 2, 4, 5, 9, 255}));
    EXPECT_TRUE(table.warnings.empty());
    TexturePoint<float> at{};
    for (size_t i = 0; i < table.uv_sets.size(); ++i) at.uv[i] = {(float(i) + 0.5f) / 8, 0.5f}; // the centre of texel i
    const MaterialRecord& r = table.records[1];
    const std::array uses{r.base_color_texture, r.metallic_roughness_texture, r.normal_texture,      r.emissive_texture,
                          r.specular_texture,   r.specular_color_texture,     r.transmission_texture};
    const TextureTables textures = table.tables().textures;
    for (size_t i = 0; i < uses.size(); ++i) {
        const auto place = std::ranges::find(table.uv_sets, sets[i]) - table.uv_sets.begin();
        const float encoded = float(place * 30) / 255.f;
        const bool is_color = i == 0 || i == 3 || i == 5;
        EXPECT_NEAR(lookup<float>(textures, uses[i], at, true).x, is_color ? decoded(encoded) : encoded, 1e-6) << texture_slots[i].name;
    }
}

TEST(TextureLookup, MoreUvSetsThanThereIsRoomForAreReportedAndReadWhite) {
    Scene scene;
    Texture black;
    black.image = make_byte_image(1, 1, 1, [] { return uint8_t(0); });
    const Id<Texture> texture = scene.textures.add(black);
    add_used_material(scene, on_uv_sets(texture, {0, 1, 2, 3, 4, 5, 6}));
    add_used_material(scene, on_uv_sets(texture, {10, 11}));
    MaterialTable table;
    build_material_table(table, scene);
    EXPECT_EQ(table.uv_sets.size(), size_t(max_uv_sets));
    ASSERT_EQ(table.warnings.size(), 1u);
    EXPECT_NE(table.warnings[0].what.find("9 UV sets; those on sets beyond 10"), std::string::npos);
    EXPECT_GE(table.records[2].base_color_texture, 0);
    EXPECT_EQ(table.records[2].metallic_roughness_texture, -1);
}

// The extension's sample model turns its arrow this way: u' of a point on the v axis grows with the angle.
TEST(TextureLookup, RotationTurnsCounterClockwiseWithVDownwards) {
    TextureRef ref;
    ref.rotation_radians = float(std::numbers::pi / 2);
    Texture texture;
    texture.image = make_byte_image(1, 1, 1, [] { return uint8_t(0); });
    const Textured textured(texture, ref);
    const TextureUse& use = textured.table.uses[size_t(textured.table.records[1].base_color_texture)];
    EXPECT_NEAR(use.u_from_v, 1, 1e-6);
    EXPECT_NEAR(use.v_from_u, -1, 1e-6);
    EXPECT_NEAR(use.u_from_u, 0, 1e-6);
}

TEST(TextureLookup, HostileCoordinatesStayInsideTheImage) {
    Random random(2);
    for (const Texture::Wrap wrap : {Texture::Wrap::repeat, Texture::Wrap::clamp_to_edge, Texture::Wrap::mirrored_repeat}) {
        for (const float scale : {1.f, 3e38f, infinite}) {
            Texture texture;
            texture.image = make_byte_image(5, 3, 4, [&] { return uint8_t(random.below(256)); });
            texture.wrap_u = texture.wrap_v = wrap;
            TextureRef ref;
            ref.scale = {scale, scale};
            const Textured textured(texture, ref);
            for (int k = 0; k < 20000; ++k) {
                const auto any_float = [&] { return std::bit_cast<float>(random.bits()); };
                const Vec4 c = textured.read(true, {any_float(), any_float()});
                for (const float v : {c.x, c.y, c.z, c.w}) ASSERT_TRUE(v >= 0 && v <= 1);
            }
            for (const float u : {nan, infinite, -infinite, 3.4e38f, -3.4e38f, -1e-30f, 1.f, -1.f, 0x1p24f}) {
                const Vec4 c = textured.read(true, {u, u});
                for (const float v : {c.x, c.y, c.z, c.w}) EXPECT_TRUE(v >= 0 && v <= 1) << u;
            }
        }
    }
}

TEST(TextureLookup, TexelNumbersAreInRangeForAnyCoordinate) {
    Random random(3);
    for (int k = 0; k < 200000; ++k) {
        const float s = std::bit_cast<float>(random.bits());
        if (!std::isfinite(s)) continue;
        const int size = 1 + random.below(random.coin() ? 4 : 65536);
        const TexturePair<float> p = texture_pair<float>(s, size, random.below(3), random.coin());
        ASSERT_TRUE(p.first >= 0 && p.first < size && p.second >= 0 && p.second < size) << s << " of " << size;
        ASSERT_TRUE(p.weight >= 0 && p.weight < 1) << s;
    }
}

TEST(TextureLookup, NoTextureAndIdleLanesReadWhite) {
    Texture texture;
    texture.image = make_byte_image(1, 1, 1, [] { return uint8_t(0); });
    const Textured textured(texture, {});
    const TextureTables tables = textured.table.tables().textures;
    EXPECT_EQ(lookup<float>(tables, -1, {}, true), (Vec4{1, 1, 1, 1}));
    EXPECT_EQ(lookup<float>(tables, 1 << 30, {}, false), (Vec4{1, 1, 1, 1}));
}

TEST(TextureTable, StoresAnImageOnceHoweverItIsRead) {
    Scene scene;
    const ImagePtr image = make_byte_image(4, 4, 3, [] { return uint8_t(7); });
    Texture repeated{.name = "a", .source = "", .image = image}, clamped = repeated;
    clamped.wrap_u = Texture::Wrap::clamp_to_edge;
    Material material;
    material.base_color_texture.texture = material.normal_texture.texture = scene.textures.add(repeated);
    material.metallic_roughness_texture.texture = scene.textures.add(clamped);
    add_used_material(scene, material);
    MaterialTable table;
    build_material_table(table, scene);
    EXPECT_EQ(table.textures.records.size(), 3u); // repeated as colour and as data, clamped as data
    for (const TextureRecord& record : table.textures.records)
        EXPECT_EQ(table.textures.levels[size_t(record.first_level)].texels, image->bytes.data()); // read where the scene holds it
    EXPECT_EQ(table.textures.memory_bytes(), 2u * (2 * 2 + 1) * 3 * sizeof(uint16_t));            // mip levels as colour and as data
    EXPECT_EQ(int64_t(table.textures.memory_bytes()), 2 * texel_bytes(*image));
    EXPECT_TRUE(table.textures.warnings.empty());
}

TEST(TextureTable, FloatDataAreReadWhereTheyLie) {
    float next = 0;
    Texture texture{.name = "", .source = "", .image = make_float_image(4, 2, 4, [&] { return next += 0.01f; })};
    const Textured textured(texture, {});
    const TextureTable& table = textured.table.textures;
    const auto texels = [&](bool is_color) {
        return table.levels[size_t(table.records[size_t(table.index_of(textured.texture, is_color))].first_level)].texels;
    };
    EXPECT_EQ(texels(false), texture.image->floats.data());
    EXPECT_NE(texels(true), texture.image->floats.data()); // sRGB is decoded
}

TEST(TextureTable, TexelsOfImagesThatStayAreTakenOver) {
    Scene scene;
    const auto add = [&](uint8_t value) {
        const ImagePtr image = make_byte_image(8, 8, 3, [&] { return value; });
        Material material;
        material.base_color_texture.texture = scene.textures.add({.name = "", .source = "", .image = image});
        return add_used_material(scene, material);
    };
    const Id<Material> gone = add(1);
    add(2);
    MaterialTable table;
    build_material_table(table, scene);
    ASSERT_EQ(table.textures.images.size(), 2u);
    const std::weak_ptr<const ImageTexels> dropped = table.textures.images[0];
    const ImageTexelsPtr kept = table.textures.images[1];
    Material plain;
    scene.materials.set(gone, plain);
    add(3);
    build_material_table(table, scene);
    ASSERT_EQ(table.textures.images.size(), 2u);
    EXPECT_EQ(table.textures.images[0], kept);
    EXPECT_TRUE(dropped.expired());
}

TEST(TextureTable, SkipsUnusedTextures) {
    Scene scene;
    const Id<Texture> texture =
        scene.textures.add({.name = "", .source = "", .image = make_byte_image(2, 2, 3, [] { return uint8_t(7); })});
    Material unused, dielectric;
    unused.base_color_texture.texture = texture;
    scene.materials.add(unused);
    dielectric.transmission_texture.texture = texture; // but transmits nothing
    add_used_material(scene, dielectric);
    MaterialTable table;
    build_material_table(table, scene);
    EXPECT_TRUE(table.textures.records.empty());
    EXPECT_EQ(table.records[1].base_color_texture, -1);
    EXPECT_EQ(table.records[2].transmission_texture, -1);
}

TEST(TextureTable, ReplacesAndCountsBadTexels) {
    Texture texture{.name = "burnt", .source = "", .image = {}};
    const float values[] = {nan, infinite, -1.f, 0.25f, 8.f, 1.f};
    size_t next = 0;
    texture.image = make_float_image(2, 1, 3, [&] { return values[next++]; });
    texture.filter = Texture::Filter::nearest;
    const Textured textured(texture, {});
    EXPECT_EQ(textured.read(true, {0.25f, 0.5f}), (Vec4{0, 0, 0, 1}));
    EXPECT_EQ(textured.read(true, {0.75f, 0.5f}), (Vec4{0.25f, 8, 1, 1})); // above 1: linear data
    ASSERT_EQ(textured.table.textures.warnings.size(), 2u);                // as colour, as data
    EXPECT_EQ(textured.table.textures.warnings[0].what, "3 values are negative or not finite: read as 0");
    EXPECT_EQ(textured.table.textures.warnings[0].where, "texture \"burnt\"");
}

TEST(TextureTable, ImagesOfInconsistentSizeAreWhite) {
    auto image = std::make_shared<Image>();
    image->width = image->height = 1000;
    image->channels = 4;
    image->bytes = {1, 2, 3, 4};
    const Textured textured(Texture{.name = "", .source = "", .image = image}, {});
    EXPECT_EQ(textured.read(true, {0.3f, 0.7f}), (Vec4{1, 1, 1, 1}));
    EXPECT_FALSE(textured.table.textures.warnings.empty());
}

} // namespace blush::TEST_FILE
