// Materials from the document to the BSDF parameters at a shading point.
#include "render/materials/material_table.h"
#include "scene/texture_slots.h"
#include "tests/shading/numbers.h"
#include "tests/shading/tables.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

namespace blush::TEST_FILE {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
constexpr Vec4 white{1, 1, 1, 1};

MaterialTable table_of(const Material& material) {
    Scene scene;
    add_used_material(scene, material);
    MaterialTable table;
    build_material_table(table, scene);
    return table;
}

template <Features S> MaterialPoint<float> point_of(const MaterialTable& table, Vec4 vertex_color = white, Vec2 uv = {0.3f, 0.6f}) {
    return material_at<S, float>(table.tables(), 1, {{{uv, uv}}}, vertex_color, true);
}

float opacity_of(const Material& material, float vertex_alpha = 1, Vec2 uv = {0, 0}, const Texture* texture = nullptr) {
    Scene scene;
    Material textured = material;
    if (texture) textured.base_color_texture.texture = scene.textures.add(*texture);
    add_used_material(scene, textured);
    MaterialTable table;
    build_material_table(table, scene);
    return opacity_at<all_features, float>(table.tables(), 1, {{{uv, uv}}}, vertex_alpha, true);
}

// Every field of a point, for comparisons of bits.
std::vector<uint32_t> bits_of(const MaterialPoint<float>& p) {
    const BsdfParams<float>& b = p.bsdf;
    std::vector<uint32_t> bits;
    const auto put = [&](float x) { bits.push_back(std::bit_cast<uint32_t>(x)); };
    for_each_value(p.bsdf, put);
    for (const Vec3& v : {p.emission, p.tangent_normal, p.clearcoat_tangent_normal, p.sigma_a})
        for (const float x : {v.x, v.y, v.z}) put(x);
    for (const bool x : {b.thin, p.double_sided, p.unlit}) bits.push_back(x);
    return bits;
}

// A material that uses each thing or not.
Material random_material(Random& random, const std::vector<Id<Texture>>& textures) {
    const auto color = [&] { return Vec3{random.unit(), random.unit(), random.unit()}; };
    const auto some = [&](float value) { return random.coin() ? value : 0.f; };
    const auto texture = [&] {
        TextureRef ref;
        if (!textures.empty() && random.coin()) ref.texture = textures[size_t(random.below(int(textures.size())))];
        ref.uv_set = uint8_t(random.below(2));
        ref.scale = {random.between(-2, 2), random.between(-2, 2)};
        return ref;
    };
    Material m;
    m.base_color = color();
    m.metallic = some(random.unit());
    m.roughness = random.unit();
    if (random.coin()) m.emissive = color();
    m.emissive_strength = random.between(0, 1000);
    m.normal_scale = some(random.between(-2, 2));
    m.double_sided = random.coin();
    m.unlit = random.below(4) == 0;
    m.ior = random.between(1, 2.5f);
    m.specular = some(random.unit());
    m.specular_color = color();
    m.transmission = some(random.unit());
    m.thickness = some(1);
    if (random.coin()) m.attenuation_color = color();
    m.attenuation_distance = some(random.unit());
    add_layers(random, m);
    for (const TextureSlot& slot : texture_slots) m.*slot.ref = texture();
    return m;
}

std::vector<Id<Texture>> add_textures(Scene& scene, Random& random) {
    std::vector<Id<Texture>> ids;
    for (int i = 0; i < 4; ++i) {
        const ImagePtr image = i < 3 ? make_byte_image(5, 4, i + 1, [&] { return uint8_t(random.below(256)); })
                                     : make_float_image(3, 7, 4, [&] { return random.between(0, 4); });
        ids.push_back(scene.textures.add({.name = "", .source = "", .image = image}));
    }
    return ids;
}

Texture texel(uint8_t r, uint8_t g, uint8_t b, uint8_t a) {
    const std::array<uint8_t, 4> values{r, g, b, a};
    size_t next = 0;
    return {.name = "", .source = "", .image = make_byte_image(1, 1, 4, [&] { return values[next++]; })};
}

} // namespace

TEST(MaterialTable, FirstRecordIsTheDefaultOfGltf) {
    MaterialTable table;
    build_material_table(table, Scene{});
    ASSERT_EQ(table.records.size(), 1u);
    const MaterialRecord& r = table.records[0];
    EXPECT_EQ(r.base_color, (Vec3{1, 1, 1}));
    EXPECT_EQ(r.metallic, 1);
    EXPECT_EQ(r.roughness, 1);
    EXPECT_EQ(table.index_of({7}), 0);
}

TEST(MaterialTable, IdsWithGapsFindTheirRecords) {
    Scene scene;
    std::vector<Id<Material>> ids;
    for (int i = 0; i < 5; ++i) {
        Material m;
        m.roughness = float(i) / 8;
        ids.push_back(scene.materials.add(m));
    }
    scene.materials.remove(ids[1]);
    MaterialTable table;
    build_material_table(table, scene);
    EXPECT_EQ(table.index_of(ids[1]), 0);
    EXPECT_EQ(table.index_of({}), 0);
    EXPECT_EQ(table.records[size_t(table.index_of(ids[3]))].roughness, 3.f / 8);
}

TEST(MaterialTable, ParametersAreMadeLegal) {
    Random random(1);
    const float odd[] = {nan, infinite, -infinite, -1.f, 0.f, 0.5f, 2.f, 3e38f, 1e-40f};
    const auto number = [&] { return odd[random.below(int(std::size(odd)))]; };
    const auto color = [&] { return Vec3{number(), number(), number()}; };
    for (int trial = 0; trial < 3000; ++trial) {
        Material m;
        m.base_color = color();
        m.opacity = number();
        m.metallic = number();
        m.roughness = number();
        m.emissive = color();
        m.emissive_strength = number();
        m.normal_scale = number();
        m.alpha = Material::Alpha(random.below(3));
        m.alpha_cutoff = number();
        m.ior = number();
        m.specular = number();
        m.specular_color = color();
        m.transmission = number();
        m.thickness = number();
        m.attenuation_color = color();
        m.attenuation_distance = number();
        const MaterialTable table = table_of(m);
        const MaterialPoint<float> p = point_of<all_features>(table, {number(), number(), number(), number()});
        const auto within = [](float x, float low, float high) { return x >= low && x <= high; };
        for (const float c : {p.bsdf.base_color.x, p.bsdf.base_color.y, p.bsdf.base_color.z}) ASSERT_TRUE(within(c, 0, 1)) << c;
        for (const float c : {p.bsdf.metallic, p.bsdf.roughness, p.bsdf.specular, p.bsdf.transmission}) ASSERT_TRUE(within(c, 0, 1)) << c;
        for (const float c : {p.emission.x, p.emission.y, p.emission.z, p.sigma_a.x, p.sigma_a.y, p.sigma_a.z}) {
            ASSERT_TRUE(within(c, 0, 1.1e30f)) << c;
        }
        for (const float c : {p.bsdf.specular_color.x, p.bsdf.specular_color.y, p.bsdf.specular_color.z})
            ASSERT_TRUE(within(c, 0, 1.1e30f)) << c;
        ASSERT_TRUE(p.bsdf.ior == 0 || within(p.bsdf.ior, 1, 1000)) << p.bsdf.ior;
        ASSERT_TRUE(within(opacity_at<all_features, float>(table.tables(), 1, {}, number(), true), 0, 1));
    }
}

TEST(MaterialTable, AbsorptionLeavesTheColourAtItsDistance) {
    const Vec3 sigma = absorption({0.25f, 1, 0.9f}, 0.1f);
    EXPECT_FLOAT_EQ(std::exp(-sigma.x * 0.1f), 0.25f);
    EXPECT_EQ(sigma.y, 0);
    EXPECT_FLOAT_EQ(std::exp(-sigma.z * 0.1f), 0.9f);
    EXPECT_EQ(absorption({0.5f, 0.5f, 0.5f}, 0), (Vec3{0, 0, 0})); // glTF's infinity
    EXPECT_EQ(absorption({7, 1, 2}, 1), (Vec3{0, 0, 0}));          // no gain
    const Vec3 black = absorption({0, nan, -1}, 1);
    EXPECT_FLOAT_EQ(black.x, 24 * std::log(2.f));
    EXPECT_EQ(black.y, black.x);
    EXPECT_EQ(black.z, black.x);
    EXPECT_TRUE(std::isfinite(absorption({0, 0, 0}, 1e-45f).x));
}

TEST(MaterialTable, AbsorptionIsForSolidsThatTransmit) {
    Material m;
    m.attenuation_color = {0.5f, 0.5f, 0.5f};
    m.attenuation_distance = 1;
    m.thickness = 1;
    EXPECT_EQ(table_of(m).records[1].sigma_a.x, 0);
    m.transmission = 1;
    EXPECT_GT(table_of(m).records[1].sigma_a.x, 0);
    EXPECT_FALSE(point_of<all_features>(table_of(m)).bsdf.thin);
    m.thickness = 0;
    EXPECT_EQ(table_of(m).records[1].sigma_a.x, 0);
    EXPECT_TRUE(point_of<all_features>(table_of(m)).bsdf.thin);
}

TEST(MaterialTable, OpacityFollowsTheAlphaMode) {
    const Texture half = texel(255, 255, 255, 51); // 0.2
    Material m;
    m.opacity = 0.5f;
    EXPECT_EQ(opacity_of(m, 0.5f, {0, 0}, &half), 1);
    m.alpha = Material::Alpha::blend;
    EXPECT_FLOAT_EQ(opacity_of(m, 0.5f, {0, 0}, &half), 0.05f);
    EXPECT_EQ(opacity_of(m, 9), 1);
    EXPECT_EQ(opacity_of(m, nan), 0);
    m.alpha = Material::Alpha::mask;
    m.alpha_cutoff = 0.5f;
    EXPECT_EQ(opacity_of(m), 1); // at the cutoff it is opaque
    EXPECT_EQ(opacity_of(m, 0.99f), 0);
    m.alpha_cutoff = 1.5f;
    m.opacity = 1;
    EXPECT_EQ(opacity_of(m), 0);
}

TEST(MaterialTable, FactorsMultiplyTheChannelsGltfNames) {
    Scene scene;
    const Id<Texture> texture = scene.textures.add(texel(51, 102, 153, 204)); // 0.2 0.4 0.6 0.8
    Material m;
    m.metallic = 0.5f;
    m.roughness = 0.5f;
    m.specular = 0.5f;
    m.transmission = 0.5f;
    m.emissive = {1, 2, 3};
    m.emissive_strength = 10;
    for (TextureRef Material::*slot : {&Material::base_color_texture, &Material::metallic_roughness_texture, &Material::emissive_texture,
                                       &Material::specular_texture, &Material::specular_color_texture, &Material::transmission_texture}) {
        (m.*slot).texture = texture;
    }
    add_used_material(scene, m);
    MaterialTable table;
    build_material_table(table, scene);
    const MaterialPoint<float> p = point_of<all_features>(table, {0.5f, 1, 1, 1});
    const auto decoded = [](double v) { return float(std::pow((v + 0.055) / 1.055, 2.4)); };
    EXPECT_FLOAT_EQ(p.bsdf.base_color.x, 0.5f * decoded(0.2));
    EXPECT_FLOAT_EQ(p.bsdf.base_color.y, decoded(0.4));
    EXPECT_FLOAT_EQ(p.bsdf.roughness, 0.2f);
    EXPECT_FLOAT_EQ(p.bsdf.metallic, 0.3f);
    EXPECT_FLOAT_EQ(p.bsdf.specular, 0.4f);
    EXPECT_FLOAT_EQ(p.bsdf.specular_color.z, decoded(0.6));
    EXPECT_FLOAT_EQ(p.bsdf.transmission, 0.1f);
    EXPECT_FLOAT_EQ(p.emission.y, 20 * decoded(0.4));
}

TEST(MaterialTable, LayerFactorsMultiplyTheChannelsGltfNames) {
    Scene scene;
    const Id<Texture> texture = scene.textures.add(texel(51, 102, 153, 204)); // 0.2 0.4 0.6 0.8
    Material m;
    m.clearcoat = m.clearcoat_roughness = m.sheen_roughness = m.anisotropy = m.iridescence = m.diffuse_transmission = 0.5f;
    m.anisotropy_rotation_radians = std::numbers::pi_v<float> / 2;
    m.sheen_color = m.diffuse_transmission_color = {0.5f, 1, 0.5f};
    m.iridescence_thickness_minimum = 100;
    m.iridescence_thickness_maximum = 600;
    for (const TextureSlot& slot : texture_slots)
        if (slot.ref != &Material::normal_texture) (m.*slot.ref).texture = texture;
    add_used_material(scene, m);
    MaterialTable table;
    build_material_table(table, scene);
    const MaterialPoint<float> p = point_of<all_features>(table);
    const LayerParams<float>& l = p.bsdf.layers;
    const auto decoded = [](double v) { return float(std::pow((v + 0.055) / 1.055, 2.4)); };
    EXPECT_FLOAT_EQ(l.clearcoat, 0.1f);
    EXPECT_FLOAT_EQ(l.clearcoat_roughness, 0.2f);
    EXPECT_FLOAT_EQ(l.sheen_color.x, 0.5f * decoded(0.2));
    EXPECT_FLOAT_EQ(l.sheen_color.y, decoded(0.4));
    EXPECT_FLOAT_EQ(l.sheen_roughness, 0.4f);
    EXPECT_FLOAT_EQ(l.iridescence, 0.1f);
    EXPECT_FLOAT_EQ(l.film_thickness, 300);
    EXPECT_FLOAT_EQ(l.diffuse_transmission, 0.4f);
    EXPECT_FLOAT_EQ(l.diffuse_transmission_color.z, 0.5f * decoded(0.6));
    // (-0.6, -0.2) normalised, then a quarter turn counter-clockwise.
    EXPECT_FLOAT_EQ(p.anisotropy.strength, 0.3f);
    EXPECT_NEAR(p.anisotropy.direction.x, 0.2 / std::sqrt(0.4), 1e-6);
    EXPECT_NEAR(p.anisotropy.direction.y, -0.6 / std::sqrt(0.4), 1e-6);
    const Vec3 n = p.clearcoat_tangent_normal;
    EXPECT_NEAR(length(n), 1, 1e-6);
    EXPECT_NEAR(n.x / n.z, -0.6 / 0.2, 1e-5);
    // Without textures, films have the larger thickness.
    for (const TextureSlot& slot : texture_slots) m.*slot.ref = {};
    EXPECT_EQ(point_of<all_features>(table_of(m)).bsdf.layers.film_thickness, 600);
}

TEST(MaterialTable, FeaturesOfLayersAreWhatTheMaterialUses) {
    Material m;
    m.metallic = 0;
    m.clearcoat_roughness = m.sheen_roughness = 0.5f; // of nothing
    constexpr Features reflecting = no_features.with(Feature::specular);
    EXPECT_EQ(features_of(m), reflecting);
    const auto with = [&](auto change) {
        Material changed = m;
        change(changed);
        return features_of(changed);
    };
    EXPECT_EQ(with([](Material& c) { c.clearcoat = 1; }), reflecting.with(Feature::clearcoat));
    EXPECT_EQ(with([](Material& c) { c.sheen_color.y = 1; }), reflecting.with(Feature::sheen));
    EXPECT_EQ(with([](Material& c) { c.anisotropy = 1; }), reflecting.with(Feature::anisotropy));
    EXPECT_EQ(with([](Material& c) { c.iridescence = 1; }), reflecting.with(Feature::iridescence));
    EXPECT_EQ(with([](Material& c) { c.diffuse_transmission = 1; }), reflecting.with(Feature::diffuse_transmission));
    // Dispersion alone needs no feature: it only has an effect in a solid with transmission.
    EXPECT_EQ(with([](Material& c) { c.dispersion = 1; }), reflecting);
    EXPECT_EQ(with([](Material& c) { c.dispersion = c.transmission = c.thickness = 1; }),
              reflecting.with(Feature::transmission).with(Feature::dispersion));
    EXPECT_EQ(with([](Material& c) { c.diffuse_transmission = c.thickness = 1; }),
              reflecting.with(Feature::transmission).with(Feature::diffuse_transmission));
    m.unlit = true;
    EXPECT_EQ(with([](Material& c) { c.clearcoat = c.anisotropy = c.iridescence = c.diffuse_transmission = c.sheen_color.x = 1; }),
              no_features.with(Feature::unlit));
}

TEST(MaterialTable, NormalMapsAreScaledAndOfUnitLength) {
    for (const float scale : {1.f, -0.5f, 4.f}) {
        Scene scene;
        Material m;
        m.normal_texture.texture = scene.textures.add(texel(204, 51, 230, 255));
        m.normal_scale = scale;
        add_used_material(scene, m);
        MaterialTable table;
        build_material_table(table, scene);
        const Vec3 n = point_of<all_features>(table).tangent_normal;
        EXPECT_NEAR(length(n), 1, 1e-6);
        EXPECT_NEAR(n.x / n.z, scale * 0.6 / (2 * 230 / 255.0 - 1), 1e-5 * std::abs(scale));
        EXPECT_NEAR(n.y / n.z, scale * -0.6 / (2 * 230 / 255.0 - 1), 1e-5 * std::abs(scale));
    }
}

TEST(MaterialTable, NormalsBelowTheSurfaceAreLiftedAndNoneIsUnusable) {
    for (const auto& [r, g, b] :
         {std::array<uint8_t, 3>{200, 30, 0}, std::array<uint8_t, 3>{0, 0, 0}, std::array<uint8_t, 3>{255, 255, 255}}) {
        Scene scene;
        Material m;
        m.normal_texture.texture = scene.textures.add(texel(r, g, b, 255));
        add_used_material(scene, m);
        MaterialTable table;
        build_material_table(table, scene);
        const Vec3 n = point_of<all_features>(table).tangent_normal;
        EXPECT_NEAR(length(n), 1, 1e-6);
        EXPECT_GE(n.z, 0);
    }
}

TEST(MaterialTable, UnlitKeepsItsColourAlone) {
    Material m;
    m.unlit = true;
    m.base_color = {0.1f, 0.2f, 0.3f};
    m.emissive = {1, 1, 1};
    m.transmission = 1;
    const MaterialPoint<float> p = point_of<all_features>(table_of(m));
    EXPECT_TRUE(p.unlit);
    EXPECT_EQ(p.emission, (Vec3{0, 0, 0}));
    EXPECT_EQ(p.bsdf.base_color, m.base_color);
    EXPECT_EQ(p.bsdf.transmission, 0);
    EXPECT_EQ(features_of(m), no_features.with(Feature::unlit));
}

TEST(MaterialTable, FeaturesAreWhatTheMaterialUses) {
    Material lambert;
    lambert.metallic = 0;
    lambert.specular = 0;
    EXPECT_EQ(features_of(lambert), no_features);
    EXPECT_EQ(features_of(Material{}), no_features.with(Feature::specular));
    Material lamp = lambert;
    lamp.emissive = {1, 0, 0};
    EXPECT_EQ(features_of(lamp), no_features.with(Feature::emissive_triangles));
    lamp.emissive_strength = 0;
    EXPECT_EQ(features_of(lamp), no_features);
    Material bumpy = lambert;
    bumpy.normal_texture.texture = {1};
    EXPECT_EQ(features_of(bumpy), no_features.with(Feature::textures).with(Feature::normal_maps));
    bumpy.normal_scale = 0;
    EXPECT_EQ(features_of(bumpy), no_features);
    Material glass = lambert;
    glass.transmission = 1;
    EXPECT_EQ(features_of(glass), no_features.with(Feature::specular).with(Feature::transmission));
    glass.thickness = 1;
    glass.attenuation_distance = 1;
    glass.attenuation_color = {1, 0.5f, 1};
    EXPECT_EQ(features_of(glass), no_features.with(Feature::specular).with(Feature::transmission).with(Feature::absorption));
}

namespace {

// A material without some features in kernels with and without them.
template <uint32_t Bits> void expect_same_bits(const Scene& scene, const MaterialTable& table, Random& random, int& compared) {
    constexpr Features kernel{Bits};
    for (const auto& [id, material] : scene.materials) {
        if (!kernel.contains(features_of(material))) continue;
        ++compared;
        for (int k = 0; k < 20; ++k) {
            const auto coordinates = [&] { return Vec2{random.between(-2, 2), random.between(-2, 2)}; };
            const TexturePoint<float> at{{{coordinates(), coordinates()}}};
            const int32_t index = table.index_of(id);
            const auto small = material_at<kernel, float>(table.tables(), index, at, white, true);
            const auto large = material_at<all_features, float>(table.tables(), index, at, white, true);
            ASSERT_EQ(bits_of(small), bits_of(large));
        }
    }
}

constexpr uint32_t bit(Feature f) { return uint32_t(f); }

} // namespace

TEST(MaterialTable, FeaturesBeyondTheNeedChangeNoBit) {
    Random random(5);
    Scene scene;
    const std::vector<Id<Texture>> textures = add_textures(scene, random);
    for (int i = 0; i < 600; ++i) add_used_material(scene, random_material(random, i % 2 == 0 ? textures : std::vector<Id<Texture>>{}));
    MaterialTable table;
    build_material_table(table, scene);
    constexpr uint32_t specular = bit(Feature::specular), transmission = bit(Feature::transmission), textured = bit(Feature::textures);
    constexpr uint32_t emissive = bit(Feature::emissive_triangles);
    int compared[6] = {};
    expect_same_bits<0>(scene, table, random, compared[0]);
    expect_same_bits<specular>(scene, table, random, compared[1]);
    expect_same_bits<specular | emissive>(scene, table, random, compared[2]);
    expect_same_bits<specular | transmission | bit(Feature::absorption)>(scene, table, random, compared[3]);
    expect_same_bits<specular | textured | emissive>(scene, table, random, compared[4]);
    expect_same_bits<specular | textured | bit(Feature::normal_maps) | bit(Feature::unlit)>(scene, table, random, compared[5]);
    for (const int n : compared) EXPECT_GT(n, 0);
}

TEST(MaterialTable, EmissionAloneIsTheEmissionOfThePoint) {
    Random random(6);
    Scene scene;
    const std::vector<Id<Texture>> textures = add_textures(scene, random);
    for (int i = 0; i < 50; ++i) add_used_material(scene, random_material(random, textures));
    MaterialTable table;
    build_material_table(table, scene);
    for (int32_t i = 0; i <= 50; ++i) {
        const TexturePoint<float> at{{{Vec2{random.unit(), random.unit()}, Vec2{random.unit(), random.unit()}}}};
        const Vec3 whole = material_at<all_features, float>(table.tables(), i, at, white, true).emission;
        EXPECT_EQ((emission_at<all_features, float>(table.tables(), i, at, true)), whole);
    }
}

TEST(MaterialTable, UpdatingOneMaterialEqualsARebuild) {
    Random random(7);
    Scene scene;
    const std::vector<Id<Texture>> textures = add_textures(scene, random);
    std::vector<Id<Material>> ids;
    for (int i = 0; i < 20; ++i) ids.push_back(add_used_material(scene, random_material(random, textures)));
    MaterialTable table;
    build_material_table(table, scene);
    int rewritten = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const Id<Material> id = ids[size_t(random.below(20))];
        scene.materials.set(id, random_material(random, textures));
        const bool done = update_material(table, scene, id);
        rewritten += done;
        if (!done) build_material_table(table, scene);
        MaterialTable fresh;
        build_material_table(fresh, scene);
        ASSERT_EQ(table.records, fresh.records);
        ASSERT_EQ(table.layers, fresh.layers);
        ASSERT_EQ(table.textures.sources, fresh.textures.sources);
        ASSERT_EQ(table.textures.images.size(), fresh.textures.images.size());
        for (size_t i = 0; i < fresh.textures.images.size(); ++i) {
            const ImageTexels &kept = *table.textures.images[i], &made = *fresh.textures.images[i];
            ASSERT_EQ(kept.image, made.image);
            ASSERT_EQ(kept.is_color, made.is_color);
            ASSERT_EQ(kept.bytes, made.bytes);
            ASSERT_EQ(kept.floats, made.floats);
            ASSERT_EQ(kept.mip_halves, made.mip_halves);
            ASSERT_EQ(kept.mip_floats, made.mip_floats);
        }
        ASSERT_EQ(std::memcmp(table.uses.data(), fresh.uses.data(), fresh.uses.size() * sizeof(TextureUse)), 0);
    }
    EXPECT_GT(rewritten, 0);
}

TEST(MaterialTable, NewTexturesOrMaterialsRequireANewTable) {
    Random random(8);
    Scene scene;
    const std::vector<Id<Texture>> textures = add_textures(scene, random);
    const Id<Material> id = add_used_material(scene, {});
    MaterialTable table;
    build_material_table(table, scene);
    Material m;
    m.base_color_texture.texture = textures[0];
    scene.materials.set(id, m);
    EXPECT_FALSE(update_material(table, scene, id));
    EXPECT_EQ(table.records[1].base_color_texture, -1);
    build_material_table(table, scene);
    EXPECT_GE(table.records[1].base_color_texture, 0);
    EXPECT_FALSE(update_material(table, scene, scene.materials.add({})));
    scene.textures.set(textures[0], texel(1, 2, 3, 4));
    EXPECT_FALSE(update_material(table, scene, id));
}

} // namespace blush::TEST_FILE
