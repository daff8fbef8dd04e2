// Which casters are kept of many: the largest ones, more for light paths than for the directions that surfaces sample.
#include "render/lights/caustic_caster_table.h"

#include "render/compile/render_scene.h"
#include "render/integrator/light_path_emission.h"
#include "tests/render/integrator/caustic_images.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>

namespace blush::test::TEST_FILE {
namespace {

// Mirror balls in rows on a floor; the radius of ball i is `radius(i)`.
template <class Radius> Scene mirror_balls(int count, const Radius& radius) {
    Scene scene;
    place(scene, floor_quad(4), lambert(0.6f));
    for (int i = 0; i < count; ++i)
        place(scene, sphere(false), metal(0), at({0.5f * float(i % 4) - 0.75f, 0.25f, 0.5f * float(i / 4) - 0.5f}, radius(i)));
    place_light(scene, caustic_light(Light::Kind::point, 100, 0.3f), at({0.5f, 3, 0.5f}));
    scene.view = looking({0, 3, 3}, {0, 0, 0}, 0.6f);
    return scene;
}

TEST(CausticCasters, AreTheLargestOnes) {
    const auto radius = [](int i) { return 0.1f + 0.001f * float(i); };
    RenderScene compiled;
    compiled.update(mirror_balls(40, radius), settings_for(8, 8, 1), full_plan(), Workers(1));
    const CausticCasterTables& all = compiled.tables().emission_casters;
    ASSERT_EQ(all.count, 32);
    EXPECT_EQ(compiled.tables().casters.count, 32);
    EXPECT_EQ(compiled.tables().guides.casters.count, 8) << "each diffuse vertex loops over them";
    for (int k = 0; k < all.count; ++k) EXPECT_NEAR(all.spheres[k].radius, radius(39 - k), 1e-4f);
}

// A lamp of 45,000 triangles above: pairs with 22 of them are not too many.
TEST(CausticCasters, BesideManyLightsAreFewer) {
    Geometry lamp;
    constexpr int n = 150;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x) lamp.positions.push_back({float(x) / n, 3, float(y) / n});
    for (uint32_t y = 0; y < n; ++y)
        for (uint32_t x = 0; x < n; ++x) {
            const uint32_t at = y * (n + 1) + x;
            for (const uint32_t corner : {at, at + 1, at + n + 1, at + 1, at + n + 2, at + n + 1}) lamp.indices.push_back(corner);
        }
    Scene scene = mirror_balls(40, [](int) { return 0.2f; });
    place(scene, std::make_shared<const Geometry>(lamp), emitter(10));
    RenderScene compiled;
    compiled.update(scene, settings_for(8, 8, 1), full_plan(), Workers(1));
    ASSERT_EQ(compiled.tables().lights.count, 45001);
    const LightPathEmission emission(compiled.tables(), compiled.bounding_sphere());
    ASSERT_FALSE(emission.empty());
    EXPECT_EQ(emission.tables(1).casters.count, 22);
}

// Light paths towards all of them have the density that their weights count: the image is that without light paths.
TEST(CausticCasters, BeyondEightBiasNothing) {
    const Scene scene = mirror_balls(12, [](int) { return 0.2f; });
    RenderSettings off = settings_for(12, 12, 256);
    off.caustics = CausticStrategy::off;
    EXPECT_TRUE(same_means(caustic_blocks(scene, settings_for(12, 12, 16), {.light_path_share = 1.f}, "light paths", true, 24, 1),
                           caustic_blocks(scene, off, {}, "light paths", false, 24, 100)));
}

} // namespace
} // namespace blush::test::TEST_FILE
