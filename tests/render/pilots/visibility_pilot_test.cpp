// The pilot of learned visibility: what it gains, that it does not depend on how the image is rendered, and that it adds no bias.
#include "render/pilots/visibility_pilot.h"

#include "render/film/film_state.h"
#include "tests/render/pilots/pilot_checks.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

#include <algorithm>
#include <cmath>

namespace blush::test::TEST_FILE {
namespace {

// A room without windows. A lamp lights it; a strong sun shines on its walls from outside.
Scene shuttered_room() {
    Scene scene;
    place(scene, floor_quad(2), lambert(0.7f));
    place(scene, ceiling_quad(2, 3), lambert(0.8f));
    place(scene, quad({-2, 0, -2}, {2, 0, -2}, {2, 3, -2}, {-2, 3, -2}), lambert(0.8f));
    place(scene, quad({-2, 0, 2}, {-2, 0, -2}, {-2, 3, -2}, {-2, 3, 2}), lambert({0.8f, 0.5f, 0.4f}));
    place(scene, quad({2, 0, 2}, {-2, 0, 2}, {-2, 3, 2}, {2, 3, 2}), lambert(0.8f));
    place(scene, quad({2, 0, -2}, {2, 0, 2}, {2, 3, 2}, {2, 3, -2}), lambert(0.8f));
    Light lamp;
    lamp.kind = Light::Kind::sphere;
    lamp.radius = 0.3f;
    lamp.intensity = 2;
    place_light(scene, lamp, at({0.5f, 2.2f, -0.5f}));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 100;
    sun.angle_radians = 0.3f;
    place_light(scene, sun, aimed({0, 0, 0}, {0.3f, -1, 0.2f}));
    scene.view = looking({-1.2f, 1.5f, 1.5f}, {0.5f, 1, -1}, 1.2f);
    return scene;
}

// Both lights see all of the floor.
Scene open_floor() {
    Scene scene;
    place(scene, floor_quad(2), lambert(0.5f));
    Light point;
    place_light(scene, point, at({-1, 2, 0}));
    place_light(scene, point, at({1, 2, 0}));
    scene.view = looking({0, 2, 3}, {0, 0, 0}, 0.7f);
    return scene;
}

RenderSettings settings_of(int64_t spp) { return settings_for(80, 48, spp); }

constexpr const char* feature = "learned visibility";
FeatureUse line_of(Renderer& renderer) { return feature_line(renderer, feature); }

FeatureUse decided(const Scene& scene, const RenderSettings& settings, unsigned threads = 2) {
    return decided_line(scene, settings, feature, threads);
}

TEST(VisibilityPilot, IsUsedWhereLightsAreHidden) {
    const FeatureUse use = decided(shuttered_room(), settings_of(8));
    EXPECT_TRUE(use.used) << use.why;
    EXPECT_GT(use.bytes.value_or(0), 0);
    EXPECT_NE(use.why.find("pilot: second moment"), std::string::npos) << use.why;
}

TEST(VisibilityPilot, IsLeftOutWhereItGainsNothing) {
    EXPECT_FALSE(decided(open_floor(), settings_of(8)).used);
    EXPECT_EQ(decided(shipped_scene("card-and-mug"), settings_of(8)).used, false);
    EXPECT_EQ(decided(Scene{}, settings_of(8)).why, "there are no two lights to select from");
    RenderSettings bsdf = settings_of(8);
    bsdf.strategy = Strategy::bsdf;
    EXPECT_EQ(decided(shuttered_room(), bsdf).why, "no light is sampled");
}

// The first sample is rendered without, the others with learned visibility.
TEST(VisibilityPilot, ReducesTheVariance) {
    const Scene scene = shuttered_room();
    RenderSettings settings = settings_of(2);
    settings.sampler = SamplerType::random;
    const auto variance = [&](int64_t sample) {
        statistics::Moments channel;
        for (uint32_t seed = 1; seed <= 8; ++seed) {
            settings.seed = seed;
            const Frame frame = rendered_in_parts(scene, settings, {{sample, 1}});
            // A part of the floor.
            for (int y = 40; y < 46; ++y)
                for (int x = 30; x < 50; ++x) channel.add(double(frame.rgba[4 * size_t(y * frame.width + x)]));
        }
        return channel.variance();
    };
    EXPECT_LT(variance(1), 0.5 * variance(0));
}

TEST(VisibilityPilot, AgreesWithBsdfSampling) {
    const Scene scene = shuttered_room();
    RenderSettings settings = settings_for(32, 24, 256);
    const auto learned = render(scene, settings).blocks(8, 8);
    settings.strategy = Strategy::bsdf;
    settings.seed = 3;
    settings.spp = 4096;
    EXPECT_TRUE(same_means(learned, render(scene, settings).blocks(8, 8)));
}

TEST(VisibilityPilot, IsTheSameWithEveryKernelAndAnyNumberOfThreads) {
    EXPECT_LT(learned_by_every_kernel(shuttered_room(), settings_of(4), learn_light_visibility).second_moment(), 0.9);
}

TEST(VisibilityPilot, DecidesOverAllSamplesButTheFirst) {
    const Scene scene = shuttered_room();
    RenderSettings settings = settings_of(8);
    const Frame whole = rendered_in_parts(scene, settings, {{0, 8}});
    EXPECT_TRUE(same_pixels(whole, rendered_in_parts(scene, settings, {{0, 1}, {1, 7}})));
    EXPECT_TRUE(same_pixels(whole, rendered_in_parts(scene, settings, {{0, 5}, {5, 3}}, 1)));
    settings.adaptive = true;
    EXPECT_TRUE(same_pixels(rendered_in_parts(scene, settings, {{0, 1}, {0, 1}, {0, 22}}), rendered_in_parts(scene, settings, {{0, 24}})));
}

TEST(VisibilityPilot, DoesNotDelayTheFirstSampleOrACoarseImage) {
    Renderer renderer({.threads = 2});
    renderer.update(shuttered_room(), settings_of(8));
    renderer.set_divider(2);
    renderer.render(0, 4);
    renderer.set_divider(1);
    renderer.render(0, 1);
    EXPECT_EQ(line_of(renderer).why, "a pilot decides after the first sample");
    EXPECT_FALSE(renderer.render(1, 1, [] { return false; }));
    EXPECT_FALSE(line_of(renderer).used) << "stopped";
    renderer.render(1, 1);
    EXPECT_TRUE(line_of(renderer).used);
    // What was learned does not change coarse images that come later.
    Renderer fresh({.threads = 2});
    fresh.update(shuttered_room(), settings_of(8));
    for (Renderer* r : {&renderer, &fresh}) {
        r->set_divider(2);
        r->render(0, 1);
        r->render(1, 3);
    }
    EXPECT_TRUE(same_pixels(renderer.resolve(), fresh.resolve()));
}

TEST(VisibilityPilot, IsTheSameAfterAnEditAsAfterAFreshStart) {
    const Scene scene = shuttered_room();
    Scene bright = scene;
    for (const auto& [id, light] : scene.lights) {
        Light brighter = light;
        brighter.intensity *= 50;
        if (light.kind == Light::Kind::sphere) bright.lights.set(id, brighter);
    }
    const RenderSettings settings = settings_of(4);
    Renderer renderer(all_planes());
    for (const Scene& next : {scene, open_floor(), bright, scene}) {
        renderer.update(next, settings);
        renderer.render(0, 4);
        EXPECT_EQ(line_of(renderer).why, decided(next, settings).why);
        EXPECT_TRUE(same_pixels(renderer.resolve(), fresh_image(next, settings, 4)));
    }
}

TEST(VisibilityPilot, ContinuesASavedFilm) {
    const Scene scene = shuttered_room();
    const RenderSettings settings = settings_of(8);
    Renderer whole({.threads = 2}), begun({.threads = 2}), continued({.threads = 2});
    for (Renderer* r : {&whole, &begun, &continued}) r->update(scene, settings);
    whole.render(0, 8);
    begun.render(0, 3);
    ASSERT_TRUE(continued.load_film(*begun.save_film(0)));
    continued.render(3, 5);
    EXPECT_TRUE(same_pixels(continued.resolve(), whole.resolve()));
}

TEST(VisibilityPilot, IsFollowedByThePathLog) { expect_log_follows_image(shuttered_room(), settings_of(8)); }

} // namespace
} // namespace blush::test::TEST_FILE
