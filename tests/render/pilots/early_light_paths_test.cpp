// Coarse images, and first samples before the pilots have run, have caustics of lights without size: light paths of these lights alone.
#include "tests/render/integrator/light_path_scenes.h"
#include "tests/render/pilots/pilot_checks.h"
#include "tests/support/images.h"

#include <cstdio>

namespace blush::test::TEST_FILE {
namespace {

using namespace light_path_scenes;
using namespace statistics;

// Smooth balls: no other strategy finds their caustics.
Scene lit_by_a_point() {
    Scene scene = balls(0);
    place_light(scene, caustic_light(Light::Kind::point, 20), at({0.2f, 2, 0.5f}));
    return scene;
}
Scene lit_by_a_sphere() {
    Scene scene = balls(0);
    place_light(scene, caustic_light(Light::Kind::point, 20, 0.2f), at({0.2f, 2, 0.5f}));
    return scene;
}

// With the light paths of later samples, which miss what these miss: caustics seen through the glass.
RenderSettings without_manifolds(int64_t spp) {
    RenderSettings settings = settings_for(48, 48, spp);
    settings.caustics = CausticStrategy::light_paths;
    return settings;
}

// Nine blocks of images of `count` samples.
std::vector<Measured> blocks_of(const Scene& scene, RenderSettings settings, int divider, int64_t count, int images, uint32_t first_seed) {
    BlockMoments moments;
    for (int k = 0; k < images; ++k) {
        settings.seed = first_seed + uint32_t(k);
        Renderer renderer({.threads = 2});
        renderer.update(scene, settings);
        renderer.set_divider(divider);
        EXPECT_TRUE(renderer.render(0, count));
        const int side = settings.width / divider / 3;
        moments.add(image_of(renderer).blocks(side, side));
    }
    return moments.measured();
}

TEST(EarlyLightPaths, BringAsMuchLightAsThoseOfLaterSamples) {
    const Scene scene = lit_by_a_point();
    const auto later = blocks_of(scene, without_manifolds(16), 1, 16, 40, 1);
    const double alpha = sidak(significance, 3);
    EXPECT_TRUE(same_means(blocks_of(scene, without_manifolds(1), 1, 1, 400, 1000), later, alpha)) << "first samples";
    EXPECT_TRUE(same_means(blocks_of(scene, without_manifolds(16), 4, 4, 1000, 2000), later, alpha)) << "coarse images";
    RenderSettings off = without_manifolds(1);
    off.caustics = CausticStrategy::off;
    EXPECT_FALSE(same_means(blocks_of(scene, off, 1, 1, 400, 1000), later, alpha)) << "the caustics are too faint for this test";
}

TEST(EarlyLightPaths, LeaveNothingInLaterSamples) {
    for (const bool adaptive : {false, true}) {
        RenderSettings settings = settings_for(48, 48, 20);
        settings.adaptive = adaptive;
        const Scene scene = lit_by_a_point();
        const Frame whole = render_in_steps(scene, settings, all_planes(1), {20});
        Renderer first(all_planes()), other(all_planes(3)), continued(all_planes());
        for (Renderer* renderer : {&first, &other}) {
            renderer->update(scene, settings);
            renderer->set_divider(4);
            ASSERT_TRUE(renderer->render(0, 3));
            ASSERT_TRUE(renderer->render(3, 2));
        }
        EXPECT_TRUE(same_pixels(first.resolve(), other.resolve())) << "threads, coarse";
        for (Renderer* renderer : {&first, &other}) {
            renderer->set_divider(1);
            ASSERT_TRUE(renderer->render(0, 1));
        }
        const Frame one = first.resolve();
        EXPECT_TRUE(same_pixels(one, other.resolve())) << "threads";
        EXPECT_TRUE(same_pixels(one, fresh_image(scene, settings, 1))) << "coarse images before";
        EXPECT_TRUE(one.missing_light.find("seen through") != std::string::npos || one.missing_light.empty()) << one.missing_light;

        const auto saved = first.save_film(0);
        ASSERT_TRUE(saved) << saved.error().text();
        continued.update(scene, settings);
        ASSERT_TRUE(continued.load_film(*saved));
        EXPECT_TRUE(same_pixels(continued.resolve(), one));
        for (Renderer* renderer : {&first, &continued}) {
            ASSERT_TRUE(renderer->render(1, 19));
            EXPECT_TRUE(same_pixels(renderer->resolve(), whole));
        }
    }
}

TEST(EarlyLightPaths, AreInTheFeatureReportAndThePathLog) {
    const Scene scene = lit_by_a_point();
    RenderSettings settings = settings_for(48, 48, 1);
    Renderer renderer({.threads = 2});
    renderer.update(scene, settings);
    ASSERT_TRUE(renderer.render(0, 1));
    const FeatureUse use = feature_line(renderer, "light paths");
    EXPECT_TRUE(use.used);
    EXPECT_EQ(use.why, "before the pilot, they alone find caustics of lights of zero size, with 1 for each camera path");
    EXPECT_GT(use.bytes.value_or(0), 0);
    const Frame frame = renderer.resolve();
    int connected = 0;
    for (int y = 0; y < 48; y += 3)
        for (int x = 0; x < 48; x += 3) {
            const std::string log = trace_sample(scene, settings, x, y, 0);
            Vec3 logged{-1, -1, -1};
            std::sscanf(log.c_str() + log.rfind("radiance ("), "radiance (%f, %f, %f)", &logged.x, &logged.y, &logged.z);
            const float* film = &frame.rgba[4 * size_t(y * 48 + x)];
            EXPECT_NEAR(logged.y, film[1], 1e-5f * film[1]) << log;
            connected += log.find("  camera     receives") != std::string::npos;
        }
    EXPECT_GT(connected, 5);
}

TEST(EarlyLightPaths, AreThereOnlyWhereNothingElseFindsTheLight) {
    const auto used = [](const Scene& scene, const RenderSettings& settings, const CausticOptions& options = {}, int divider = 1) {
        Renderer renderer({.threads = 2, .caustics = options});
        renderer.update(scene, settings);
        renderer.set_divider(divider);
        EXPECT_TRUE(renderer.render(0, 1));
        return feature_line(renderer, "light paths").used;
    };
    RenderSettings settings = settings_for(48, 48, 1);
    EXPECT_TRUE(used(lit_by_a_point(), settings));
    EXPECT_TRUE(used(lit_by_a_point(), settings, {}, 4));
    EXPECT_FALSE(used(lit_by_a_sphere(), settings));
    EXPECT_FALSE(used(lit_by_a_sphere(), settings, {}, 4));
    EXPECT_FALSE(used(lit_by_a_point(), settings, {.light_path_share = 0}));
    for (const CausticStrategy other : {CausticStrategy::off, CausticStrategy::guiding, CausticStrategy::manifold}) {
        settings.caustics = other;
        EXPECT_FALSE(used(lit_by_a_point(), settings)) << int(other);
    }
}

// Manifold sampling finds this light with the seeds of before an edit.
TEST(EarlyLightPaths, AreLeftOutWithKeptSeeds) {
    const Scene before = lit_by_a_point();
    Scene after = before;
    Light brighter = before.lights.begin()->value;
    brighter.intensity *= 1.5f;
    after.lights.set(before.lights.begin()->id, brighter);
    const RenderSettings settings = settings_for(48, 48, 16);
    Renderer renderer({.threads = 2, .caustics = {.manifold_sampling = true}, .begins_trained = true});
    renderer.update(before, settings);
    ASSERT_TRUE(renderer.render(0, 2));
    for (const int divider : {4, 1}) {
        renderer.update(after, settings);
        renderer.set_divider(divider);
        ASSERT_TRUE(renderer.render(0, 1));
        ASSERT_TRUE(renderer.begins_with_seeds());
        EXPECT_FALSE(feature_line(renderer, "light paths").used);
    }
    ASSERT_TRUE(renderer.settle_first_sample());
    Renderer fresh({.threads = 2, .caustics = {.manifold_sampling = true}});
    fresh.update(after, settings);
    ASSERT_TRUE(fresh.render(0, 1));
    EXPECT_TRUE(feature_line(fresh, "light paths").used);
    EXPECT_TRUE(same_pixels(renderer.resolve(), fresh.resolve()));
}

} // namespace
} // namespace blush::test::TEST_FILE
