// Manifold sampling on surfaces that are not Lambertian: its agreement in the mean with the other strategies and with a closed form.
#include "tests/render/integrator/caustic_images.h"
#include "tests/render/integrator/manifold/lit_casters.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

// A floor of metal and plastic in turn, of several colours and roughnesses, with bumps and stretched highlights.
Scene on_a_textured_floor() {
    Scene scene = smooth_balls();
    Geometry floor = *floor_quad(2, 0.02f);
    floor.serial = next_payload_serial();
    floor.normals.assign(4, {0, 1, 0});
    floor.tangents.assign(4, {1, 0, 0, 1});
    const std::array<Vec3, 4> colors{{{0.9f, 0.2f, 0.4f}, {0.8f, 0.8f, 0.8f}, {0.3f, 0.3f, 0.9f}, {0.5f, 0.9f, 0.1f}}},
        surfaces{{{0, 0.3f, 1}, {0, 0.5f, 0}, {0, 0.8f, 1}, {0, 0.4f, 0.3f}}},
        normals{{{0.6f, 0.5f, 0.9f}, {0.4f, 0.6f, 0.9f}, {0.5f, 0.5f, 1}, {0.5f, 0.4f, 0.9f}}};
    Material m = metal(1);
    m.base_color_texture.texture = add_texture(scene, float_image(2, 2, colors));
    m.metallic_roughness_texture.texture = add_texture(scene, float_image(2, 2, surfaces));
    m.normal_texture.texture = add_texture(scene, float_image(2, 2, normals));
    m.anisotropy = 0.6f;
    place(scene, std::make_shared<const Geometry>(std::move(floor)), m);
    return scene;
}

// A floor of each material between diffuse walls, and diffuse floors between walls of it: light vertices are on some of them.
std::vector<std::pair<const char*, Scene>> rough_scenes() {
    std::vector<std::pair<const char*, Scene>> scenes;
    const auto add = [&](const char* name, Scene scene, const Material& walls) {
        add_walls(scene, walls);
        place(scene, ceiling_quad(0.7f, 2.5f), emitter(10));
        scenes.emplace_back(name, std::move(scene));
    };
    for (const auto& [name, material] : rough_materials()) add(name, smooth_balls(material), lambert({0.8f, 0.75f, 0.7f}));
    add("textures, bumps and anisotropy", on_a_textured_floor(), lambert({0.8f, 0.75f, 0.7f}));
    add("walls of plastic", smooth_balls(), rough_materials()[0].second);
    add("rough glass", smooth_balls(glass(0.3f, 1.5f)), lambert({0.8f, 0.75f, 0.7f}));
    return scenes;
}

TEST(RoughReceivers, AgreeWithTheOtherStrategies) {
    const auto scenes = rough_scenes();
    const double significance_each = sidak(significance, int(2 * scenes.size()));
    for (const auto& [name, scene] : scenes) {
        SCOPED_TRACE(name);
        RenderSettings settings = settings_for(36, 36, 48);
        const auto blocks = [&](float light_paths, bool manifolds, uint32_t seed) {
            return caustic_blocks(
                scene, settings,
                {.light_path_share = light_paths, .manifold_sampling = manifolds, .light_vertices = true, .shared_chains = true},
                "manifold sampling", manifolds, 16, seed);
        };
        const auto without = blocks(0, false, 1);
        settings.spp = 24;
        EXPECT_TRUE(same_means(blocks(0, true, 1000), without, significance_each));
        EXPECT_TRUE(same_means(blocks(0.5f, true, 2000), without, significance_each)) << "with light paths";
    }
}

// Lights without size: nothing finds them by chance. Metal balls have no chains but these.
TEST(RoughReceivers, AgreeWithLightPathsForLightsWithoutSize) {
    for (const auto& [name, material] : rough_materials()) {
        SCOPED_TRACE(name);
        Scene balls;
        place(balls, floor_quad(2), material);
        place(balls, round_sphere(), metal(0), at({-0.7f, 0.5f, 0}, 0.4f));
        place(balls, round_sphere(), metal(0), at({0.7f, 0.5f, 0.2f}, 0.4f));
        place_light(balls, caustic_light(Light::Kind::point, 20), at({0.1f, 2.5f, 0.5f}));
        balls.view = looking({0, 2.5f, 4}, {0, 0.3f, 0}, 0.6f);
        RenderSettings settings = settings_for(36, 36, 24);
        settings.max_bounces = 2; // a smooth floor mirrors its own caustics, which light paths do not find
        const auto blocks = [&](float light_paths, uint32_t seed) {
            return caustic_blocks(balls, settings, {.light_path_share = light_paths, .manifold_sampling = true}, "manifold sampling", true,
                                  16, seed);
        };
        EXPECT_TRUE(same_means(blocks(0.5f, 1000), blocks(0, 1), sidak(significance, 4)));
    }
}

// A slab of glass over a floor changes no direction: of light from direction cosine c, (1 - F(c))^2 arrives by refraction alone. Without
// the slab, NEE finds the light. Paths end before others arrive.
TEST(RoughReceivers, FindTheSunThroughASlab) {
    constexpr double ior = 1.5, c = 0.8;
    const double g = std::sqrt(ior * ior - 1 + c * c), s = (c - g) / (c + g), p = (ior * ior * c - g) / (ior * ior * c + g);
    const double passed = (1 - (s * s + p * p) / 2) * (1 - (s * s + p * p) / 2);
    for (const auto& [name, material] : rough_materials()) {
        SCOPED_TRACE(name);
        // Means of the image's rows: a rough lobe is brightest in some of them.
        const auto rows = [&](bool slab, int max_bounces, uint32_t seed) {
            Scene scene;
            place(scene, floor_quad(3), material);
            Transform above = at({0, 1, 0});
            above.scale = {20, 0.1f, 20};
            if (slab) place(scene, cube(false), glass(0, float(ior)), above);
            Light sun = caustic_light(Light::Kind::sun, 4);
            sun.angle_radians = 0.0087f;
            place_light(scene, sun, aimed({0, 5, 0}, normalize(Vec3{0.6f, -0.8f, 0})));
            scene.view = looking({0.8f, 0.7f, 0.1f}, {0, 0, 0}, 0.6f);
            RenderSettings settings = settings_for(24, 24, 8);
            settings.max_bounces = max_bounces;
            return image_regions(scene, settings, {.light_path_share = 0.f, .manifold_sampling = slab}, 32, seed, 24, 4,
                                 [&](Renderer& renderer) { EXPECT_EQ(feature_line(renderer, "manifold sampling").used, slab); });
        };
        auto expected = rows(false, 1, 1);
        for (Measured& row : expected) {
            row.mean = row.mean * passed;
            row.error = row.error * passed;
        }
        EXPECT_TRUE(same_means(rows(true, 3, 1000), expected, sidak(significance, 4)));
    }
}

// Tiles as a glTF file has them by default, with a reflection, do not lose the pool's caustics.
TEST(RoughReceivers, AreThoseOfAPoolWithGlossyTiles) {
    Scene pool = shipped_scene("pool");
    for (auto [id, material] : pool.materials) {
        if (material.transmission > 0) continue;
        material.specular = 1, material.roughness = 0.4f;
        pool.materials.set(id, material);
    }
    Renderer renderer({.threads = 2});
    renderer.update(pool, settings_for(96, 54, 4));
    renderer.render(0, 4);
    EXPECT_TRUE(feature_line(renderer, "manifold sampling").used);
    EXPECT_TRUE(feature_line(renderer, "shared chains").used);
}

} // namespace
} // namespace blush::test::TEST_FILE
