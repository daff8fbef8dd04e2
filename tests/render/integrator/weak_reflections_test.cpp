// Window glass, plastic and varnish reflect the sun onto what is before them: light that few rays find, as the sun is small, and light
// paths carry.
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/film/found_by.h"
#include "render/integrator/kernel_settings.h"
#include "render/integrator/light_path_emission.h"
#include "tests/render/integrator/caustic_images.h"
#include "tests/support/statistics.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr float real_sun = 0.53f * std::numbers::pi_v<float> / 180; // angular diameter
constexpr float albedo = 0.6f;

// Reflect the sun, and no light from the floor.
Material black_plastic(float roughness) {
    Material m = plastic(roughness);
    m.base_color = {0, 0, 0};
    return m;
}
Material coated_black() {
    Material m = lambert(0);
    m.clearcoat = 1;
    return m;
}

// A floor before an upright wall of this width; seen from above, 2 half metres of it.
Scene dark_terrace(const Material& floor, const Material& wall, float wall_width, float half) {
    Scene scene;
    place(scene, floor_quad(5), floor);
    const float x = wall_width / 2;
    place(scene, quad({-x, 0, 0}, {x, 0, 0}, {x, 3, 0}, {-x, 3, 0}), wall);
    scene.view = looking({0, 4, 1.2f}, {0, 0, 1}, 2 * std::atan(half / 4));
    return scene;
}
// In a sun that the wall reflects onto the floor at 45 degrees.
Scene terrace(float sun_angle, const Material& floor, const Material& wall, float wall_width, float half) {
    Scene scene = dark_terrace(floor, wall, wall_width, half);
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 10;
    sun.angle_radians = sun_angle;
    place_light(scene, sun, aimed({0, 5, 0}, {0, -1, -1}));
    return scene;
}
// In a sky with a sun at the same place, of four texels.
Scene sunny_sky(float sun_radiance) {
    Scene scene = dark_terrace(lambert(albedo), plastic(0), 3, 0.6f);
    std::vector<Vec3> texels(size_t(64 * 32), Vec3{1, 1, 1} * 0.3f);
    for (const size_t y : {7u, 8u})
        for (const size_t x : {0u, 63u}) texels[64 * y + x] = Vec3{1, 1, 1} * sun_radiance;
    scene.environment.kind = Environment::Kind::image;
    scene.environment.image = float_image(64, 32, texels);
    return scene;
}
Scene bulb_before_wall(float radius) {
    Scene scene = dark_terrace(lambert(albedo), plastic(0), 3, 0.6f);
    place_light(scene, caustic_light(Light::Kind::point, 100, radius), at({0, 2.5f, 3}));
    return scene;
}

// The same as an emissive mesh.
Scene lamp_before_wall(float radius) {
    Scene scene = dark_terrace(lambert(albedo), plastic(0), 3, 0.6f);
    place(scene, sphere(false), emitter(100), at({0, 2.5f, 3}, radius));
    return scene;
}

// No more than one reflection: neither light from the floor by the wall, nor twice from the wall.
RenderSettings one_reflection(int64_t spp) {
    RenderSettings settings = settings_for(16, 16, spp);
    settings.max_bounces = 2;
    return settings;
}

Measured image_of_sun(const Scene& scene) {
    return image_regions(scene, one_reflection(16), {}, 32, 0, 16, 16,
                         [](Renderer& renderer) { EXPECT_TRUE(feature_line(renderer, "light paths").used); })[0];
}

TEST(WeakReflections, OfTheSunHaveTheirClosedForm) {
    const double cosine = std::numbers::sqrt2 / 2, reflected = 0.04 + 0.96 * std::pow(1 - cosine, 5); // Schlick's Fresnel term
    const double of_sun = albedo / std::numbers::pi * 10 * cosine;
    for (const Material& wall : {window_glass(), black_plastic(0), coated_black()})
        for (const float angle : {0.f, real_sun, 0.1f}) {
            const Measured seen = image_of_sun(terrace(angle, lambert(albedo), wall, 3, 0.6f));
            EXPECT_TRUE(is_mean(seen, of_sun * (1 + reflected), sidak(significance, 9), 1e-4 * of_sun)) << angle;
            EXPECT_LT(seen.error.x, 0.025 * of_sun * reflected) << "the test sees a tenth of the reflection";
        }
}

// The reflection of a real sun is that of a parallel one, on a floor with a lobe, too.
TEST(WeakReflections, OfAParallelSunAndARealOneAgreeOnPlastic) {
    const auto shown = [](float angle, uint32_t seed) {
        return caustic_blocks(terrace(angle, plastic(0.6f), window_glass(), 3, 0.6f), one_reflection(16), {}, "light paths", true, 24,
                              seed);
    };
    EXPECT_TRUE(same_means(shown(real_sun, 1), shown(0, 100)));
}

// Means of nine blocks: with a share of light paths or without.
std::vector<Measured> blocks_with(const Scene& scene, std::optional<float> share, int64_t spp) {
    return caustic_blocks(scene, settings_for(12, 12, spp), {.light_path_share = share}, "light paths", true, 24, 1);
}
std::vector<Measured> blocks_without(const Scene& scene, int64_t spp) {
    RenderSettings settings = settings_for(12, 12, spp);
    settings.caustics = CausticStrategy::off;
    return caustic_blocks(scene, settings, {}, "light paths", false, 24, 100);
}

// Of narrow lobes and of lights that rays find, too: the same image without light paths.
TEST(WeakReflections, AreThoseThatPathsOfTheCameraFind) {
    Material coated = lambert(0.3f);
    coated.clearcoat = 1;
    coated.clearcoat_roughness = 0.15f;
    std::vector<Scene> scenes{sunny_sky(3000), bulb_before_wall(0.4f), lamp_before_wall(0.3f)};
    for (const Material& wall : {plastic(0.1f), plastic(0.15f), coated}) scenes.push_back(terrace(0.1f, plastic(0.6f), wall, 3, 0.6f));
    for (size_t k = 0; k < scenes.size(); ++k)
        EXPECT_TRUE(
            same_means(blocks_with(scenes[k], 1.f, 16), blocks_without(scenes[k], 256), sidak(significance, int64_t(scenes.size()))))
            << k;
}

// The same with the roughness in a texture.
Scene with_roughness_texture(Scene scene) {
    std::vector<Id<Material>> ids;
    for (const auto& [id, material] : scene.materials)
        if (material.specular > 0) ids.push_back(id);
    for (const Id<Material> id : ids) {
        Material m = *scene.materials.find(id);
        m.metallic_roughness_texture.texture = add_texture(scene, float_image(1, 1, std::vector<Vec3>{{0, m.roughness, 1}}));
        m.roughness = 1;
        scene.materials.set(id, m);
    }
    return scene;
}

TEST(WeakReflections, OfRoughnessByATextureAreThoseOfTheFactor) {
    for (const Material& wall : {plastic(0), plastic(0.1f)})
        for (const float angle : {0.f, real_sun}) {
            const auto rendered = [&](const Scene& scene) {
                Renderer renderer({.threads = 2, .planes = {}});
                const RenderSettings settings = settings_for(16, 16, 8);
                renderer.update(scene, settings);
                EXPECT_TRUE(renderer.render(0, settings.spp));
                EXPECT_TRUE(feature_line(renderer, "light paths").used);
                return renderer.resolve().rgba;
            };
            const Scene scene = terrace(angle, lambert(albedo), wall, 3, 0.6f);
            EXPECT_EQ(rendered(with_roughness_texture(scene)), rendered(scene)) << wall.roughness << " " << angle;
        }
}

// Fine checks of gloss: their mean roughness does not reflect the sun as they do, so no strategy may filter them.
TEST(WeakReflections, OfATextureOfRoughnessAreThoseThatPathsOfTheCameraFind) {
    Scene scene = terrace(0.1f, plastic(0.6f), plastic(1), 3, 0.6f);
    std::vector<Vec3> texels;
    for (int i = 0; i < 64; ++i) texels.push_back({0, (i + i / 8) % 2 ? 0.9f : 0.1f, 0});
    const Id<Material> wall = std::prev(scene.materials.end())->id;
    Material m = *scene.materials.find(wall);
    m.metallic_roughness_texture.texture = add_texture(scene, float_image(8, 8, texels));
    m.metallic_roughness_texture.scale = {64, 64};
    scene.materials.set(wall, m);
    EXPECT_TRUE(same_means(blocks_with(scene, 1.f, 64), blocks_without(scene, 1024)));
}

// NEE finds a parallel sun by lobes with a density, but rarely where they are narrow: the pilot combines both strategies.
TEST(WeakReflections, OfAParallelSunByNarrowLobesAreFoundByLightPaths) {
    for (const Material& wall : {plastic(0.1f), metal(0.1f)}) {
        const Scene scene = terrace(0, lambert(albedo), wall, 3, 0.6f);
        const auto with = blocks_with(scene, {}, 64), without = blocks_without(scene, 256);
        EXPECT_TRUE(same_means(with, without));
        for (size_t k = 0; k < with.size(); ++k) EXPECT_LT(with[k].error.x, without[k].error.x) << "with a quarter of the samples";
    }
}

// NEE finds direct light without noise: light paths leave all of it to NEE, on surfaces that are not Lambertian, too.
TEST(WeakReflections, LeaveDirectLightToTheCamerasPaths) {
    const Scene scene = terrace(real_sun, plastic(0.6f), window_glass(), 0.5f, 1);
    const auto rendered = [&](CausticStrategy caustics) {
        RenderSettings settings = one_reflection(8);
        settings.caustics = caustics;
        PlaneSet planes;
        planes.strategies = true;
        Renderer renderer({.threads = 2, .planes = planes, .caustics = {}});
        renderer.update(scene, settings);
        EXPECT_TRUE(renderer.render(0, settings.spp));
        EXPECT_EQ(feature_line(renderer, "light paths").used, caustics != CausticStrategy::off);
        return renderer.resolve();
    };
    const Frame with = rendered(CausticStrategy::light_paths), without = rendered(CausticStrategy::off);
    EXPECT_EQ(with.strategies[size_t(FoundBy::nee)], without.strategies[size_t(FoundBy::nee)]);
    const std::vector<Vec3>& splats = with.strategies[size_t(FoundBy::light_path)];
    double beside = 0, before = 0; // the wall: rows of the image are of one x
    for (size_t x = 0; x < 16; ++x) {
        for (size_t y = 0; y < 4; ++y) beside += double(splats[16 * y + x].x);
        for (size_t y = 7; y < 9; ++y) before += double(splats[16 * y + x].x);
    }
    EXPECT_EQ(beside, 0) << "the sun lights it alone";
    EXPECT_GT(before, 0);
}

// Rays find what weak reflectors show of even skies: these have no light paths, and nothing to decide.
TEST(WeakReflections, OfEvenSkiesAreLeftToRays) {
    for (const auto& [radiance, casters] : {std::pair(3000.f, 1), std::pair(3.f, 0)}) {
        RenderScene compiled;
        compiled.update(sunny_sky(radiance), settings_for(8, 8, 1), full_plan(), Workers(1));
        EXPECT_EQ(compiled.tables().emission_casters.count, casters) << radiance;
        EXPECT_EQ(compiled.tables().casters.count, 0);
    }
}

// A lamp of a large area is found by rays, however a weak reflector shows it; a small one is not.
TEST(WeakReflections, AreGivenLightPathsByLightsThatAreSmall) {
    Scene scene = terrace(real_sun, lambert(albedo), window_glass(), 3, 0.3f);
    place(scene, ceiling_quad(0.5f, 2.5f), emitter(10));
    place(scene, ceiling_quad(0.1f, 2.4f), emitter(20));
    place_light(scene, caustic_light(Light::Kind::point, 100, 0.05f), at({0, 2.5f, 3}));
    RenderScene compiled;
    compiled.update(expand_area_lights(scene), settings_for(8, 8, 1), full_plan(), Workers(1));
    const SceneTables& tables = compiled.tables();
    ASSERT_EQ(tables.emission_casters.count, 1);
    EXPECT_EQ(tables.casters.count, 0);
    const LightPathEmission emission(tables, compiled.bounding_sphere());
    const EmissionTables pairs = emission.tables(1);
    int small = 0, large = 0;
    for (int32_t light = 0; light < pairs.lights; ++light) {
        const LightRecord& record = tables.lights.lights[light];
        const bool of_large_mesh = LightKind(record.kind) == LightKind::triangle && record.emission.x == 10;
        EXPECT_EQ(pairs.chances[2 * light] > 0, !of_large_mesh);
        (of_large_mesh ? large : small) += 1;
    }
    EXPECT_EQ(large, 2);
    EXPECT_EQ(small, 4) << "the sun, the bulb and two triangles";
}

// The area of a mesh counts, not that of its triangles.
TEST(WeakReflections, OfLargeMeshesOfSmallTrianglesAreLeftToRays) {
    for (const auto& [scale, casters] : {std::pair(0.1f, 1), std::pair(0.6f, 0)}) {
        Scene scene = dark_terrace(lambert(albedo), plastic(0), 3, 0.6f);
        place(scene, sphere(false), emitter(10), at({0, 2.5f, 3}, scale));
        RenderScene compiled;
        compiled.update(scene, settings_for(8, 8, 1), full_plan(), Workers(1));
        EXPECT_EQ(compiled.tables().emission_casters.count, casters) << scale;
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
