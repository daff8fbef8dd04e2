// The pilot of learned portals: what it gains, that it does not depend on how the image is rendered, and that it adds no bias.
#include "render/pilots/portal_pilot.h"

#include "tests/render/pilots/pilot_checks.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace blush::test::TEST_FILE {
namespace {

// A white room with a window of 1 m2 under an even sky.
Scene window_room() {
    Scene scene;
    place(scene, quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}), lambert(0.7f));
    place(scene, ceiling_quad(2, 3), lambert(0.8f));
    place(scene, quad({-2, 0, -2}, {2, 0, -2}, {2, 3, -2}, {-2, 3, -2}), lambert(0.8f));
    place(scene, quad({-2, 0, 2}, {-2, 0, -2}, {-2, 3, -2}, {-2, 3, 2}), lambert({0.8f, 0.5f, 0.4f}));
    place(scene, quad({2, 0, 2}, {-2, 0, 2}, {-2, 3, 2}, {2, 3, 2}), lambert(0.8f));
    place(scene, quad({2, 0, -2}, {2, 0, 2}, {2, 1, 2}, {2, 1, -2}), lambert(0.8f));
    place(scene, quad({2, 2, -2}, {2, 2, 2}, {2, 3, 2}, {2, 3, -2}), lambert(0.8f));
    place(scene, quad({2, 1, -2}, {2, 1, -0.5f}, {2, 2, -0.5f}, {2, 2, -2}), lambert(0.8f));
    place(scene, quad({2, 1, 0.5f}, {2, 1, 2}, {2, 2, 2}, {2, 2, 0.5f}), lambert(0.8f));
    constant_world(scene, 1);
    scene.view = looking({-1.2f, 1.5f, 1.5f}, {0.5f, 1, -1}, 1.2f);
    return scene;
}

// The sky beside a lamp, so that light sampling shares its samples.
Scene lit_window_room() {
    Scene scene = window_room();
    Light lamp;
    lamp.kind = Light::Kind::sphere;
    lamp.radius = 0.2f;
    lamp.intensity = 0.3f;
    place_light(scene, lamp, at({-0.5f, 2.2f, 0.5f}));
    return scene;
}

// A map with a bright half, which light sampling covers by itself.
Scene mapped_window_room() {
    Scene scene = lit_window_room();
    std::vector<Vec3> texels;
    for (int i = 0; i < 32; ++i) texels.push_back(i % 8 < 4 ? Vec3{0.2f, 0.3f, 0.5f} : Vec3{3, 2, 1});
    scene.environment.kind = Environment::Kind::image;
    scene.environment.image = float_image(8, 4, texels);
    return scene;
}

// With MIS compensation light sampling leaves even skies out.
RenderSettings settings_of(int64_t spp) {
    RenderSettings settings = settings_for(80, 48, spp);
    settings.mis_compensation = true;
    return settings;
}

constexpr const char* feature = "learned portals";
FeatureUse line_of(Renderer& renderer) { return feature_line(renderer, feature); }

FeatureUse decided(const Scene& scene, const RenderSettings& settings, unsigned threads = 2) {
    return decided_line(scene, settings, feature, threads);
}

TEST(PortalPilot, FindsTheWindowOfARoom) {
    for (const Scene& scene : {window_room(), lit_window_room(), mapped_window_room()}) {
        const FeatureUse use = decided(scene, settings_of(8));
        EXPECT_TRUE(use.used) << use.why;
        ASSERT_TRUE(use.pilot);
        EXPECT_LT(use.pilot->cost(), 0.8) << use.why;
        EXPECT_GT(use.bytes.value_or(0), 0);
    }
}

TEST(PortalPilot, IsLeftOutWhereItGainsNothing) {
    Scene open;
    place(open, floor_quad(5), lambert(0.5f));
    constant_world(open, 1);
    open.view = looking({0, 2, 3}, {0, 0, 0}, 0.7f);
    EXPECT_FALSE(decided(open, settings_of(8)).used);
    EXPECT_EQ(decided(shipped_scene("cornell"), settings_of(8)).why, "no environment lights the scene");
    Scene backdrop = window_room();
    backdrop.environment.lights_scene = false;
    EXPECT_EQ(decided(backdrop, settings_of(8)).why, "no environment lights the scene");
    for (const Strategy strategy : {Strategy::bsdf, Strategy::light}) {
        RenderSettings one = settings_of(8);
        one.strategy = strategy;
        EXPECT_EQ(decided(window_room(), one).why, "light and BSDF sampling are not combined");
    }
}

// Light sampling alone decides how these images differ in the mean: BSDF sampling does not know of portals.
TEST(PortalPilot, AgreesWithBsdfSampling) {
    for (const Scene& scene : {window_room(), lit_window_room(), mapped_window_room()}) {
        RenderSettings settings = settings_for(32, 24, 512);
        ASSERT_TRUE(decided(scene, settings).used);
        const auto learned = render(scene, settings).blocks(8, 8);
        settings.strategy = Strategy::bsdf;
        settings.seed = 3;
        settings.spp = 4096;
        EXPECT_TRUE(same_means(learned, render(scene, settings).blocks(8, 8)));
    }
}

// The first sample is rendered without, the others with portals.
TEST(PortalPilot, ReducesTheVariance) {
    RenderSettings settings = settings_of(2);
    settings.sampler = SamplerType::random;
    // Of the median pixel: some see the edge of the window, which portals do not change.
    const auto variance = [&](int64_t sample) {
        std::vector<statistics::Moments> pixels(size_t(settings.width * settings.height));
        for (uint32_t seed = 1; seed <= 16; ++seed) {
            settings.seed = seed;
            const Frame frame = rendered_in_parts(window_room(), settings, {{sample, 1}});
            for (size_t i = 0; i < pixels.size(); ++i) pixels[i].add(double(frame.rgba[4 * i]));
        }
        std::ranges::nth_element(pixels, pixels.begin() + std::ptrdiff_t(pixels.size() / 2), {}, &statistics::Moments::variance);
        return pixels[pixels.size() / 2].variance();
    };
    EXPECT_LT(variance(1), 0.5 * variance(0));
}

TEST(PortalPilot, IsTheSameWithEveryKernelAndAnyNumberOfThreads) {
    EXPECT_TRUE(learned_by_every_kernel(mapped_window_room(), settings_of(4), learn_portals).figures);
}

TEST(PortalPilot, DecidesOverAllSamplesButTheFirst) {
    const Scene scene = mapped_window_room();
    RenderSettings settings = settings_of(8);
    const Frame whole = rendered_in_parts(scene, settings, {{0, 8}});
    EXPECT_TRUE(same_pixels(whole, rendered_in_parts(scene, settings, {{0, 1}, {1, 7}})));
    EXPECT_TRUE(same_pixels(whole, rendered_in_parts(scene, settings, {{0, 5}, {5, 3}}, 1)));
    settings.adaptive = true;
    EXPECT_TRUE(same_pixels(rendered_in_parts(scene, settings, {{0, 1}, {0, 1}, {0, 22}}), rendered_in_parts(scene, settings, {{0, 24}})));
}

TEST(PortalPilot, IsTheSameAfterAnEditAsAfterAFreshStart) {
    const Scene scene = lit_window_room();
    Scene red = scene, walled = scene;
    red.environment.color = {1, 0.1f, 0.1f};
    place(walled, quad({2.1f, 0, -2}, {2.1f, 0, 2}, {2.1f, 3, 2}, {2.1f, 3, -2}), lambert(0.8f));
    const RenderSettings settings = settings_of(4);
    Renderer renderer(all_planes());
    for (const Scene& next : {scene, red, walled, scene}) {
        renderer.update(next, settings);
        renderer.render(0, 4);
        EXPECT_EQ(line_of(renderer).why, decided(next, settings).why);
        EXPECT_TRUE(same_pixels(renderer.resolve(), fresh_image(next, settings, 4)));
    }
}

TEST(PortalPilot, IsFollowedByThePathLog) { expect_log_follows_image(lit_window_room(), settings_of(8)); }

} // namespace
} // namespace blush::test::TEST_FILE
