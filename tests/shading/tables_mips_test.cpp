// Mip levels, and lookups with a footprint.
#include "core/box_filter.h"
#include "core/half.h"
#include "core/srgb.h"
#include "render/materials/material_table.h"
#include "render/materials/texture_mips.h"
#include "tests/shading/tables.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace blush::TEST_FILE {
namespace {

TEST(Half, EveryValueRoundTrips) {
    for (uint32_t bits = 0; bits < 0x7c00; ++bits) {
        const float value = half_value<float>(int32_t(bits));
        const int exponent = int(bits >> 10);
        const double expected = exponent ? std::ldexp(1024 + (bits & 1023), exponent - 25) : std::ldexp(bits, -24);
        ASSERT_EQ(value, float(expected));
        ASSERT_EQ(half_bits(value), bits);
    }
}

TEST(Half, RoundsToTheNearest) {
    Random random(1);
    for (int k = 0; k < 100000; ++k) {
        const float x = std::ldexp(1 + random.unit(), random.below(40) - 25);
        const double rounded = half_value<float>(int32_t(half_bits(x)));
        ASSERT_LE(std::abs(rounded - x), x < 0x1p-14f ? 0x1p-25 : double(x) * 0x1p-11) << x;
    }
    EXPECT_EQ(half_bits(std::numeric_limits<float>::infinity()), 0x7bffu);
    EXPECT_EQ(half_bits(1 + 0x1p-11f), half_bits(1.f)) << "ties to even";
}

TEST(TextureMips, HaveTheMeanOfTheImageWhateverItsSize) {
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 2}, {5, 3}, {1, 7}, {16, 4}, {33, 31}}) {
        const auto texel = [&](int x, int y, int c) { return float((x * 7 + y * 13 + c * 5) % 17); };
        std::array<double, 4> sum{};
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 4; ++c) sum[size_t(c)] += double(texel(x, y, c));
        const auto read = [&](int y, float* rgba) {
            for (int i = 0; i < 4 * width; ++i) rgba[i] = texel(i / 4, y, i % 4);
        };
        std::vector<std::vector<float>> levels(size_t(mip_count(width, height)));
        make_mips(width, height, read, [&](int level, int y, std::span<const float> rgba) {
            std::vector<float>& mip = levels.at(size_t(level));
            EXPECT_EQ(rgba.size(), 4 * size_t(halved(width, level)));
            EXPECT_EQ(mip.size(), size_t(y) * rgba.size()) << "from the top";
            mip.insert(mip.end(), rgba.begin(), rgba.end());
        });
        for (int level = 1; level < int(levels.size()); ++level) {
            const std::vector<float>& mip = levels[size_t(level)];
            const int texels = halved(width, level) * halved(height, level);
            EXPECT_EQ(mip.size(), 4 * size_t(texels));
            std::array<double, 4> mip_sum{};
            for (size_t i = 0; i < mip.size(); ++i) mip_sum[i % 4] += double(mip[i]);
            // Six roundings for each halving of numbers below 17.
            for (size_t c = 0; c < 4; ++c)
                EXPECT_NEAR(mip_sum[c] / texels, sum[c] / (width * height), 17 * 6 * (level + 1) * 0x1p-24) << width << " x " << height;
        }
    }
}

struct Filtered {
    MaterialTable table;

    Filtered(const Texture& texture, const TextureRef& ref = {}) {
        Scene scene;
        Material material;
        material.base_color_texture = material.metallic_roughness_texture = ref;
        material.base_color_texture.texture = material.metallic_roughness_texture.texture = scene.textures.add(texture);
        add_used_material(scene, material);
        build_material_table(table, scene);
    }
    Vec4 read(bool as_color, Vec2 uv, float width, bool filtered = true) const {
        const MaterialRecord& r = table.records[1];
        return lookup<float>(table.tables().textures, as_color ? r.base_color_texture : r.metallic_roughness_texture, {{{uv}}, {{width}}},
                             true, filtered);
    }
};

Texture noise(int width, int height, bool floats, Random& random) {
    Texture t;
    t.image = floats ? make_float_image(width, height, 3, [&] { return random.unit(); })
                     : make_byte_image(width, height, 3, [&] { return uint8_t(random.below(256)); });
    return t;
}

TEST(TextureFilter, UpToATexelItIsTheImageItselfBitForBit) {
    Random random(2);
    for (const bool floats : {false, true}) {
        const Texture texture = noise(16, 8, floats, random);
        const Filtered filtered(texture, {.texture = {}, .offset = {0.1f, 0}, .scale = {2, 3}, .rotation_radians = 0.7f});
        const float texel = 1 / std::sqrt(16.f * 8 * 2 * 3); // in units of the UV set
        for (int k = 0; k < 1000; ++k) {
            const Vec2 uv{random.between(-2, 2), random.between(-2, 2)};
            const bool as_color = random.coin();
            const Vec4 point = filtered.read(as_color, uv, 0);
            EXPECT_EQ(filtered.read(as_color, uv, random.unit() * 0.999f * texel), point);
            EXPECT_EQ(filtered.read(as_color, uv, 5, false), point);
            EXPECT_NE(filtered.read(as_color, uv, 1.5f * texel), point);
        }
    }
}

TEST(TextureFilter, WidestFootprintsGiveTheMean) {
    Random random(3);
    for (const bool floats : {false, true})
        for (const auto& [width, height] : {std::pair{8, 8}, {5, 9}}) {
            const Texture texture = noise(width, height, floats, random);
            const Filtered filtered(texture);
            std::array<double, 3> mean{}, light{};
            const double texels = width * height;
            for (size_t i = 0; i < size_t(texels) * 3; ++i) {
                const double v = floats ? double(texture.image->floats[i]) : texture.image->bytes[i] / 255.0;
                mean[i % 3] += v / texels;
                light[i % 3] += linear_from_srgb(v) / texels;
            }
            for (const float far : {10.f, 1e30f, std::numeric_limits<float>::infinity()}) {
                const Vec4 color = filtered.read(true, {0.3f, 0.9f}, far), data = filtered.read(false, {0.3f, 0.9f}, far);
                const std::array got{color.x, color.y, color.z, data.x, data.y, data.z};
                for (size_t c = 0; c < 6; ++c) // in half precision where there are 8 bits
                    EXPECT_NEAR(got[c], c < 3 ? light[c] : mean[c - 3], 0x1p-12 + 1e-6);
            }
        }
}

TEST(TextureFilter, EachDoublingAveragesFourTimesAsManyTexels) {
    Random random(4);
    const Texture texture = noise(16, 16, true, random);
    const Filtered filtered(texture);
    for (int level = 0; level <= 4; ++level) {
        const int size = 1 << level;
        for (int y = 0; y < 16; y += size)
            for (int x = 0; x < 16; x += size) {
                double mean = 0;
                for (int j = 0; j < size; ++j)
                    for (int i = 0; i < size; ++i)
                        mean += double(texture.image->floats[size_t(((y + j) * 16 + x + i) * 3)]) / (size * size);
                const Vec2 center{(float(x) + 0.5f * float(size)) / 16, (float(y) + 0.5f * float(size)) / 16};
                EXPECT_NEAR(filtered.read(false, center, float(size) / 16).x, mean, 1e-6);
            }
    }
    // In between, in proportion to the width.
    const Vec2 uv{0.37f, 0.61f};
    const float two = filtered.read(false, uv, 2 / 16.f).x, four = filtered.read(false, uv, 4 / 16.f).x;
    for (const float share : {0.25f, 0.5f, 0.75f})
        EXPECT_NEAR(filtered.read(false, uv, (2 + 2 * share) / 16).x, two + share * (four - two), 1e-6);
}

TEST(TextureFilter, AnyFootprintReadsTexels) {
    Random random(5);
    Texture texture = noise(7, 3, false, random);
    texture.filter = Texture::Filter::nearest;
    const Filtered filtered(texture);
    for (int k = 0; k < 100000; ++k) {
        const Vec4 c = filtered.read(random.coin(), {random.unit(), random.unit()}, std::bit_cast<float>(random.bits()));
        for (const float v : {c.x, c.y, c.z, c.w}) ASSERT_TRUE(v >= 0 && v <= 1);
    }
}

} // namespace
} // namespace blush::TEST_FILE
