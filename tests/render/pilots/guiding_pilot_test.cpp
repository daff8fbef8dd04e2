// The pilot of path guiding: where it pays, that it does not depend on how the image is rendered, and that it adds no bias.
#include "render/pilots/guiding_pilot.h"

#include "tests/render/pilots/pilot_checks.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace blush::test::TEST_FILE {
namespace {

// A glass ball and a mirror ball between a floor and a ceiling.
Scene balls() {
    Scene scene;
    place(scene, floor_quad(3), lambert(0.7f));
    place(scene, ceiling_quad(3, 3), lambert({0.3f, 0.6f, 0.9f}));
    place(scene, sphere(false), glass(0, 1.5f), at({-0.9f, 0.8f, 0.3f}, 0.7f));
    place(scene, sphere(false), metal(0), at({0.9f, 0.9f, -0.4f}, 0.8f));
    scene.view = looking({0, 1.5f, 6}, {0, 1.5f, 0}, 0.6f);
    return scene;
}
Scene balls_under_lamp() {
    Scene scene = balls();
    place(scene, ceiling_quad(0.5f, 2.9f), emitter(10));
    return scene;
}
// All light comes through the glass: the lamp is in the middle of a closed ball.
Scene bulb() {
    Scene scene;
    place(scene, floor_quad(3), lambert(0.7f));
    place(scene, ceiling_quad(3, 3), lambert({0.3f, 0.6f, 0.9f}));
    place(scene, sphere(false), glass(0, 1.3f), at({0, 1.5f, 0}, 0.6f));
    place(scene, sphere(false), emitter(40), at({0, 1.5f, 0}, 0.15f));
    scene.view = looking({0, 1.5f, 6}, {0, 0.5f, 0}, 0.6f);
    return scene;
}

RenderSettings settings_of(int64_t spp) { return settings_for(80, 48, spp); }

constexpr const char* feature = "path guiding";
FeatureUse decided(const Scene& scene, const RenderSettings& settings) { return decided_line(scene, settings, feature); }

TEST(GuidingPilot, PaysWhereLightIsFocused) {
    for (const Scene& scene : {balls_under_lamp(), glass_ball_in_sun(), bulb()}) {
        const FeatureUse use = decided(scene, settings_of(8));
        EXPECT_TRUE(use.used) << use.why;
        ASSERT_TRUE(use.pilot) << use.why;
        EXPECT_LT(use.pilot->cost(), 0.5) << use.why;
        EXPECT_GT(use.bytes.value_or(0), 0);
    }
}

TEST(GuidingPilot, IsLeftOutWhereNothingFocuses) {
    EXPECT_EQ(decided(shipped_scene("cornell"), settings_of(8)).why, "no smooth surface has light to focus");
    RenderSettings settings = settings_of(8);
    settings.strategy = Strategy::bsdf;
    EXPECT_EQ(decided(balls_under_lamp(), settings).why, "no smooth surface has light to focus");
    settings = settings_of(8);
    settings.max_bounces = 1;
    EXPECT_EQ(decided(balls_under_lamp(), settings).why, "paths end before light has been focused");
    Scene hidden = glass_ball_in_sun(); // a roof keeps the sun from the ball
    place(hidden, ceiling_quad(3, 2), lambert(0.5f));
    EXPECT_FALSE(decided(hidden, settings_of(8)).used);
}

// BSDF sampling alone is not guided: it finds all caustics by chance.
TEST(GuidingPilot, AgreesWithBsdfSampling) {
    for (const Scene& scene : {balls_under_lamp(), glass_ball_in_sun(), bulb()}) {
        RenderSettings settings = settings_for(32, 24, 256);
        ASSERT_TRUE(decided(scene, settings).used);
        const auto guided = render(scene, settings).blocks(8, 8);
        settings.reuse = 8;
        settings.seed = 5;
        const auto shared = render(scene, settings).blocks(8, 8);
        settings.reuse = 1;
        settings.strategy = Strategy::bsdf;
        settings.seed = 3;
        settings.spp = 4096;
        const auto by_chance = render(scene, settings).blocks(8, 8);
        EXPECT_TRUE(same_means(guided, by_chance, statistics::sidak(statistics::significance, 2)));
        EXPECT_TRUE(same_means(shared, by_chance, statistics::sidak(statistics::significance, 2))) << "path reuse";
    }
}

// Sum of relative squared errors of all pixels but the worst hundredth, which fireflies decide.
double error_of(const std::vector<float>& rgba, const std::vector<float>& truth) {
    std::vector<double> errors;
    for (size_t i = 0; i < rgba.size(); i += 4) {
        const double about = double(truth[i]), d = double(rgba[i]) - about;
        errors.push_back(d * d / (about * about + 0.01));
    }
    std::ranges::sort(errors);
    return std::accumulate(errors.begin(), errors.end() - std::ptrdiff_t(errors.size() / 100), 0.0);
}

// Against many samples: without guiding, most pixels miss the caustic, and the variance of few samples does not show it.
TEST(GuidingPilot, ReducesTheError) {
    for (const Scene& scene : {glass_ball_in_sun(), balls_under_lamp()}) {
        RenderSettings settings = settings_of(1024);
        const std::vector<float> truth = rendered_in_parts(scene, settings, {{0, 1024}}).rgba;
        statistics::Moments gains;
        for (uint32_t repeat = 1; repeat <= 8; ++repeat) {
            settings = settings_of(17);
            settings.seed = repeat;
            const Frame guided = rendered_in_parts(scene, settings, {{1, 16}});
            std::vector<float> plain(truth.size());
            for (uint32_t k = 0; k < 16; ++k) {
                settings.seed = 100 * repeat + k;
                const Frame first = rendered_in_parts(scene, settings, {{0, 1}});
                for (size_t i = 0; i < plain.size(); ++i) plain[i] += first.rgba[i] / 16;
            }
            gains.add(error_of(plain, truth) - error_of(guided.rgba, truth));
        }
        EXPECT_GT(gains.mean, 4 * gains.error());
    }
}

TEST(GuidingPilot, IsTheSameWithEveryKernelAndAnyNumberOfThreads) {
    const auto pilot = [](const auto& context, auto&&... others) {
        return learn_path_guiding(context, *trace_caustic_photons(context, others...), others...);
    };
    EXPECT_TRUE(learned_by_every_kernel(balls_under_lamp(), settings_of(4), pilot).figures());
}

// What is gained is so much that the first sample is rendered again when a second one follows.
TEST(GuidingPilot, DecidesOverAllSamplesOfSeveral) {
    const Scene scene = glass_ball_in_sun();
    RenderSettings settings = settings_of(8);
    const Frame whole = rendered_in_parts(scene, settings, {{0, 8}});
    for (const unsigned threads : {1u, 3u}) {
        EXPECT_TRUE(same_pixels(whole, rendered_in_parts(scene, settings, {{0, 1}, {1, 7}}, threads)));
        EXPECT_TRUE(same_pixels(whole, rendered_in_parts(scene, settings, {{0, 5}, {5, 3}}, threads)));
    }
    settings.adaptive = true;
    EXPECT_TRUE(same_pixels(rendered_in_parts(scene, settings, {{0, 1}, {0, 1}, {0, 22}}), rendered_in_parts(scene, settings, {{0, 24}})));
}

TEST(GuidingPilot, FirstSampleOfSeveralIsGuided) {
    const Scene scene = glass_ball_in_sun();
    const RenderSettings settings = settings_of(2);
    const Frame alone = rendered_in_parts(scene, settings, {{0, 1}}), second = rendered_in_parts(scene, settings, {{1, 1}}),
                both = rendered_in_parts(scene, settings, {{0, 1}, {1, 1}});
    size_t other = 0;
    for (size_t i = 0; i < both.rgba.size(); i += 4) {
        const float first = 2 * both.rgba[i] - second.rgba[i];
        other += std::abs(first - alone.rgba[i]) > 1e-3f * (1 + std::abs(first));
    }
    EXPECT_GT(other, 10);
    EXPECT_EQ(both.samples, 2);
    // The rays of the discarded sample are not those of the image.
    EXPECT_EQ(both.rays.camera, rendered_in_parts(scene, settings, {{0, 2}}).rays.camera);
    EXPECT_EQ(both.rays.bounce, rendered_in_parts(scene, settings, {{0, 2}}).rays.bounce);
}

TEST(GuidingPilot, IsTheSameAfterAnEditAsAfterAFreshStart) {
    const Scene scene = balls_under_lamp();
    Scene bright = scene, moved = scene;
    bright.view = looking({1, 1.5f, 6}, {0, 1, 0}, 0.6f);
    place(moved, sphere(false), metal(0), at({0, 0.4f, 1.5f}, 0.3f));
    const RenderSettings settings = settings_of(4);
    Renderer renderer(all_planes());
    for (const Scene& next : {scene, bright, moved, scene}) {
        renderer.update(next, settings);
        renderer.render(0, 4);
        EXPECT_EQ(feature_line(renderer, feature).why, decided(next, settings).why);
        EXPECT_TRUE(same_pixels(renderer.resolve(), fresh_image(next, settings, 4)));
    }
}

// They do not depend on the camera.
TEST(GuidingPilot, KeepsThePhotonsWhenOnlyTheViewChanges) {
    const Scene scene = balls_under_lamp();
    Scene turned = scene, moved = scene;
    turned.view = looking({1, 1.5f, 6}, {0, 1, 0}, 0.6f);
    place(moved, sphere(false), metal(0), at({0, 0.4f, 1.5f}, 0.3f));
    const RenderSettings settings = settings_of(4);
    const auto tiles_of = [&](Renderer& renderer, const Scene& next) { // of all pilots
        std::atomic<int> tiles = 0;
        renderer.update(next, settings);
        EXPECT_TRUE(renderer.decide([&] { return ++tiles > 0; }));
        return tiles.load();
    };
    const auto fresh_tiles = [&](const Scene& next) {
        Renderer renderer(all_planes());
        return tiles_of(renderer, next);
    };
    Renderer renderer(all_planes());
    EXPECT_EQ(tiles_of(renderer, scene), fresh_tiles(scene));
    EXPECT_LE(tiles_of(renderer, turned), fresh_tiles(turned) - 8); // the least number of tiles of photons
    EXPECT_EQ(tiles_of(renderer, moved), fresh_tiles(moved));
}

TEST(GuidingPilot, IsFollowedByThePathLog) { expect_log_follows_image(balls_under_lamp(), settings_of(8)); }

} // namespace
} // namespace blush::test::TEST_FILE
