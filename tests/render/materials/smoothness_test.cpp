// How smooth surfaces are, by factors and by textures, and what follows: casters of light paths, and light that is missing.
#include "render/materials/smoothness.h"

#include "render/compile/render_scene.h"
#include "render/integrator/kernel_settings.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

constexpr Smoothness nowhere{};

Material coated(float coat_roughness) {
    Material m = lambert(0.5f);
    m.clearcoat = 1;
    m.clearcoat_roughness = coat_roughness;
    return m;
}

TEST(Smoothness, OfFactors) {
    EXPECT_EQ(smoothness_of(metal(0)), (Smoothness{.casts_caustics = 1, .is_mirror = 1}));
    EXPECT_EQ(smoothness_of(metal(0.2f)), (Smoothness{.casts_caustics = 1}));
    EXPECT_EQ(smoothness_of(metal(0.21f)), nowhere);
    EXPECT_EQ(smoothness_of(glass(0, 1.5f)), (Smoothness{.casts_caustics = 1, .is_mirror = 1, .is_glass = 1}));
    EXPECT_EQ(smoothness_of(window_glass()), (Smoothness{.reflects_weakly = 1, .is_mirror = 1}));
    EXPECT_EQ(smoothness_of(plastic(0.15f)), (Smoothness{.reflects_weakly = 1}));
    EXPECT_EQ(smoothness_of(plastic(0.16f)), nowhere);
    EXPECT_EQ(smoothness_of(coated(0)), (Smoothness{.reflects_weakly = 1, .is_mirror = 1}));
    EXPECT_EQ(smoothness_of(coated(0.16f)), nowhere);
    EXPECT_EQ(smoothness_of(lambert(1)), nowhere);
    Material blended = plastic(0.1f), unlit = metal(0);
    blended.alpha = Material::Alpha::blend;
    unlit.unlit = true;
    EXPECT_EQ(smoothness_of(blended), nowhere);
    EXPECT_EQ(smoothness_of(unlit), nowhere);
}

// One surface with a texture, as green for roughness and blue for metal.
struct Textured {
    Scene scene;
    Material material;
    Id<Node> node;

    Textured(Material m, TextureRef Material::*slot, int width, int height, const std::vector<Vec3>& texels,
             const GeometryPtr& geometry = floor_quad(1))
        : material(std::move(m)) {
        (material.*slot).texture = add_texture(scene, float_image(width, height, texels));
        node = place(scene, geometry, material);
    }
    const MeshPart& part() const { return scene.meshes.find(scene.nodes.find(node)->mesh)->parts[0]; }
    template <class Edit> void edit(const Edit& change) {
        Material m = *scene.materials.find(part().material);
        change(m);
        scene.materials.set(part().material, m);
    }
    Smoothness smoothness() const {
        MaterialTable table;
        build_material_table(table, scene);
        return smoothness_of(*part().geometry, *scene.materials.find(part().material), part().material, table);
    }
};
const std::vector<Vec3> quarter_smooth{{0, 0, 1}, {0, 1, 1}, {0, 1, 1}, {0, 1, 1}};

// The edges of the smooth texel pass by some 16 of the 256 points.
constexpr float tolerance = 1.f / 16;

TEST(Smoothness, OfTexturesIsTheShareOfTheArea) {
    const Smoothness of_metal = Textured(metal(1), &Material::metallic_roughness_texture, 2, 2, quarter_smooth).smoothness();
    EXPECT_NEAR(of_metal.casts_caustics, 0.25f, tolerance);
    EXPECT_EQ(of_metal.is_mirror, of_metal.casts_caustics);
    EXPECT_EQ(of_metal.reflects_weakly, 0);
    const Smoothness of_plastic = Textured(plastic(1), &Material::metallic_roughness_texture, 2, 2, quarter_smooth).smoothness();
    EXPECT_EQ(of_plastic.reflects_weakly, of_metal.casts_caustics);
    EXPECT_EQ(of_plastic.casts_caustics, 0);
    const Smoothness of_coat = Textured(coated(1), &Material::clearcoat_roughness_texture, 2, 2, quarter_smooth).smoothness();
    EXPECT_EQ(of_coat.reflects_weakly, of_metal.casts_caustics);
    const Smoothness of_glass =
        Textured(glass(1, 1.5f), &Material::metallic_roughness_texture, 2, 2, {{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}}).smoothness();
    EXPECT_EQ(of_glass.is_glass, of_metal.casts_caustics);
    EXPECT_EQ(of_glass.casts_caustics, of_metal.casts_caustics);
    // Textures scale factors: 0.5 of 0.3 is nearly smooth, and not a mirror.
    const Smoothness half = Textured(plastic(0.3f), &Material::metallic_roughness_texture, 1, 1, {{0, 0.5f, 0}}).smoothness();
    EXPECT_EQ(half, (Smoothness{.reflects_weakly = 1}));
}

// Padding of a texture atlas is often black: texels that no surface shows do not count.
TEST(Smoothness, IgnoresTexelsOutsideOfTheSurface) {
    Textured textured(plastic(1), &Material::metallic_roughness_texture, 2, 2, quarter_smooth);
    textured.edit([](Material& m) { m.metallic_roughness_texture.scale = {0.45f, 0.45f}; });
    EXPECT_EQ(textured.smoothness().reflects_weakly, 1) << "the upper left texel alone";
    textured.edit([](Material& m) { m.metallic_roughness_texture.offset = {0.5f, 0.5f}; });
    EXPECT_EQ(textured.smoothness(), nowhere);
}

// The second of two triangles has nine tenths of the area, and the smooth half of the texture.
TEST(Smoothness, CountsAreaNotTriangles) {
    Geometry g;
    std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {8, 0, 0}, {5, 3, 0}};
    g.uv.resize(1);
    for (size_t i = 0; i < 6; ++i) g.uv[0].push_back({i < 3 ? 0.1f : 0.9f, 0.5f});
    g.positions.assign(positions.begin(), positions.end());
    g.indices = {0, 1, 2, 3, 4, 5};
    const auto share = [&](const Geometry& geometry) {
        return Textured(plastic(1), &Material::metallic_roughness_texture, 2, 1, {{0, 1, 0}, {0, 0, 0}},
                        std::make_shared<Geometry>(geometry))
            .smoothness()
            .reflects_weakly;
    };
    EXPECT_NEAR(share(g), 0.9f, 1.f / 256);
    for (const float scale : {1e-25f, 1e25f}) {
        Geometry scaled = g;
        for (Vec3& p : scaled.positions) p = p * scale;
        EXPECT_NEAR(share(scaled), 0.9f, 1.f / 256) << scale;
    }
    positions[0].x = std::numeric_limits<float>::quiet_NaN();
    g.positions.assign(positions.begin(), positions.end());
    EXPECT_EQ(share(g), 1) << "a triangle without a finite area has no points";
    for (Vec3& p : positions) p = {0, 0, 0};
    g.positions.assign(positions.begin(), positions.end());
    EXPECT_EQ(share(g), 0) << "nor has a surface without area";
}

TEST(Smoothness, TexturesDecideOnlyIfFactorsAllowIt) {
    const auto with_texture = [](Material m, TextureRef Material::*slot) {
        (m.*slot).texture = Id<Texture>{1};
        return m;
    };
    EXPECT_TRUE(is_smooth_by_texture(with_texture(plastic(1), &Material::metallic_roughness_texture)));
    EXPECT_TRUE(is_smooth_by_texture(with_texture(coated(0.5f), &Material::clearcoat_roughness_texture)));
    EXPECT_TRUE(is_smooth_by_texture(with_texture(coated(0), &Material::clearcoat_texture)));
    EXPECT_FALSE(is_smooth_by_texture(plastic(0)));
    EXPECT_FALSE(is_smooth_by_texture(with_texture(plastic(0), &Material::base_color_texture)));
    EXPECT_FALSE(is_smooth_by_texture(with_texture(lambert(0.5f), &Material::metallic_roughness_texture)));
    EXPECT_FALSE(is_smooth_by_texture(with_texture(plastic(0.5f), &Material::specular_texture)));
    EXPECT_TRUE(may_cast_caustics(with_texture(metal(1), &Material::metallic_roughness_texture)));
    EXPECT_FALSE(may_cast_caustics(metal(1)));
    EXPECT_FALSE(may_cast_caustics(with_texture(plastic(1), &Material::metallic_roughness_texture)));
}

struct Casters {
    int mirrors_and_glass, all;
    bool missing;
    bool operator==(const Casters&) const = default;
};
Casters casters_of(RenderScene& compiled, const Scene& scene, const UpdatePlan& plan) {
    compiled.update(scene, settings_for(8, 8, 1), plan, Workers(1));
    return {compiled.tables().casters.count, compiled.tables().emission_casters.count,
            !compiled.missing_light(CausticFinders::light_paths).empty()};
}
Casters casters_of(const Scene& scene) {
    RenderScene compiled;
    return casters_of(compiled, scene, full_plan());
}

// Under a point light without size.
TEST(Smoothness, ByTextureMakesCastersAsByFactor) {
    Light point;
    point.intensity = 10;
    const auto textured = [&](const Material& material, float roughness) {
        Textured t(material, &Material::metallic_roughness_texture, 1, 1, {{0, roughness, 1}});
        place_light(t.scene, point, at({0, 3, 0}));
        return casters_of(t.scene);
    };
    const auto plain = [&](const Material& material) {
        Scene scene;
        place(scene, floor_quad(1), material);
        place_light(scene, point, at({0, 3, 0}));
        return casters_of(scene);
    };
    for (const float roughness : {0.f, 0.1f, 0.18f, 0.3f}) {
        EXPECT_EQ(textured(metal(1), roughness), plain(metal(roughness))) << roughness;
        EXPECT_EQ(textured(plastic(1), roughness), plain(plastic(roughness))) << roughness;
    }
    EXPECT_EQ(textured(metal(1), 0), (Casters{1, 1, true}));
    EXPECT_EQ(textured(plastic(1), 0.1f), (Casters{0, 1, false}));
    EXPECT_EQ(textured(plastic(1), 0.3f), (Casters{0, 0, false}));
}

// A mirror on less than a quarter of a surface gets light paths alone.
TEST(Smoothness, OfASmallPartOfAMirrorIsAWeakReflector) {
    Light point;
    point.intensity = 10;
    std::vector<Vec3> texels(64, {0, 1, 1});
    for (size_t i = 0; i < 8; ++i) texels[i].y = 0;
    Textured eighth(metal(1), &Material::metallic_roughness_texture, 8, 8, texels);
    place_light(eighth.scene, point, at({0, 3, 0}));
    EXPECT_EQ(casters_of(eighth.scene), (Casters{0, 1, true}));
}

// Edits of the image, of factors, and of the slot of the texture compile to the same casters as a fresh start.
TEST(Smoothness, FollowsEdits) {
    Textured t(plastic(1), &Material::metallic_roughness_texture, 1, 1, {{0, 1, 0}});
    Light point;
    point.intensity = 10;
    place_light(t.scene, point, at({0, 3, 0}));
    RenderScene compiled;
    EXPECT_EQ(casters_of(compiled, t.scene, full_plan()), (Casters{0, 0, false}));
    const auto after = [&](const auto& change, const Casters& expected) {
        const Scene before = t.scene;
        t.edit(change);
        EXPECT_EQ(casters_of(compiled, t.scene, plan(diff(before, settings_for(8, 8, 1), t.scene, settings_for(8, 8, 1)))), expected);
        EXPECT_EQ(casters_of(t.scene), expected);
    };
    after(
        [&](Material& m) {
            Texture texture = *t.scene.textures.find(m.metallic_roughness_texture.texture);
            texture.image = float_image(1, 1, std::vector<Vec3>{{0, 0.1f, 1}});
            t.scene.textures.set(m.metallic_roughness_texture.texture, texture);
        },
        {0, 1, false});
    after([](Material& m) { m.roughness = 0; }, {0, 1, true});
    after([](Material& m) { m.metallic = 1; }, {1, 1, true});
    after([](Material& m) { m.metallic_roughness_texture.texture = {}; }, {1, 1, true});
    after([](Material& m) { m.roughness = 1; }, {0, 0, false});
}

} // namespace
} // namespace blush::test::TEST_FILE
