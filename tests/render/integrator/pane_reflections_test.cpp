// Window glass reflects the sun onto what is before it: light that rays cannot find, as the sun is small, and light paths carry.
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/film/found_by.h"
#include "render/integrator/kernel_settings.h"
#include "render/integrator/light_path_emission.h"
#include "tests/render/integrator/caustic_images.h"
#include "tests/support/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr float real_sun = 0.53f * std::numbers::pi_v<float> / 180; // angular diameter
constexpr float albedo = 0.6f;

// A floor before an upright pane of this width, in a sun that is reflected onto it at 45 degrees; seen from above, 2 half metres of it.
Scene terrace(float sun_angle, const Material& floor, float pane_width, float half) {
    Scene scene;
    place(scene, floor_quad(5), floor);
    const float x = pane_width / 2;
    place(scene, quad({-x, 0, 0}, {x, 0, 0}, {x, 3, 0}, {-x, 3, 0}), window_glass());
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 10;
    sun.angle_radians = sun_angle;
    place_light(scene, sun, aimed({0, 5, 0}, {0, -1, -1}));
    scene.view = looking({0, 4, 1.2f}, {0, 0, 1}, 2 * std::atan(half / 4));
    return scene;
}

// No more than one reflection: neither light from the floor by the pane, nor twice from the pane.
RenderSettings one_reflection(int64_t spp) {
    RenderSettings settings = settings_for(16, 16, spp);
    settings.max_bounces = 2;
    return settings;
}

TEST(PaneReflections, OfTheSunHaveTheirClosedForm) {
    const double cosine = std::numbers::sqrt2 / 2, reflected = 0.04 + 0.96 * std::pow(1 - cosine, 5); // Schlick's Fresnel term
    const double of_sun = albedo / std::numbers::pi * 10 * cosine;
    for (const float angle : {0.f, real_sun, 0.1f}) {
        const Scene scene = terrace(angle, lambert(albedo), 3, 0.6f);
        BlockMoments moments;
        RenderSettings settings = one_reflection(16);
        for (uint32_t seed = 0; seed < 32; ++seed) {
            settings.seed = seed;
            Renderer renderer({.threads = 2, .caustics = {}});
            renderer.update(scene, settings);
            ASSERT_TRUE(renderer.render(0, settings.spp));
            EXPECT_TRUE(feature_line(renderer, "light paths").used) << angle;
            moments.add(image_of(renderer).blocks(settings.width, settings.height));
        }
        const Measured seen = moments.measured()[0];
        EXPECT_TRUE(is_mean(seen, of_sun * (1 + reflected), sidak(significance, 3), 1e-4 * of_sun)) << angle;
        EXPECT_LT(seen.error.x, 0.025 * of_sun * reflected) << "the test sees a tenth of the reflection";
    }
}

// The reflection of a real sun is that of a parallel one, on a floor with a lobe, too.
TEST(PaneReflections, OfAParallelSunAndARealOneAgreeOnPlastic) {
    const auto shown = [](float angle, uint32_t seed) {
        return caustic_blocks(terrace(angle, plastic(0.6f), 3, 0.6f), one_reflection(16), {}, "light paths", true, 24, seed);
    };
    EXPECT_TRUE(same_means(shown(real_sun, 1), shown(0, 100)));
}

// NEE finds direct light without noise: light paths leave all of it to NEE, on surfaces that are not Lambertian, too.
TEST(PaneReflections, LeaveDirectLightToTheCamerasPaths) {
    const Scene scene = terrace(real_sun, plastic(0.6f), 0.5f, 1);
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
    double beside = 0, before = 0; // the pane: rows of the image are of one x
    for (size_t x = 0; x < 16; ++x) {
        for (size_t y = 0; y < 4; ++y) beside += double(splats[16 * y + x].x);
        for (size_t y = 7; y < 9; ++y) before += double(splats[16 * y + x].x);
    }
    EXPECT_EQ(beside, 0) << "the sun lights it alone";
    EXPECT_GT(before, 0);
}

// A lamp of an area is found by rays, however the pane reflects it.
TEST(PaneReflections, AreGivenLightPathsBySunsAndNotByLamps) {
    Scene scene = terrace(real_sun, lambert(albedo), 3, 0.3f);
    place(scene, ceiling_quad(0.5f, 2.5f), emitter(10));
    RenderScene compiled;
    compiled.update(expand_area_lights(scene), settings_for(8, 8, 1), full_plan(), Workers(1));
    const SceneTables& tables = compiled.tables();
    ASSERT_EQ(tables.emission_casters.count, 1);
    EXPECT_EQ(tables.casters.count, 0);
    const LightPathEmission emission(tables, compiled.bounding_sphere());
    const EmissionTables pairs = emission.tables(1);
    int suns = 0;
    for (int32_t light = 0; light < pairs.lights; ++light) {
        const bool is_sun = LightKind(tables.lights.lights[light].kind) == LightKind::sun;
        EXPECT_EQ(pairs.chances[2 * light] > 0, is_sun);
        suns += is_sun;
    }
    EXPECT_EQ(suns, 1);
    EXPECT_GT(pairs.lights, 1);
}

} // namespace
} // namespace blush::test::TEST_FILE
