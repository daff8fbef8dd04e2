// Progressive photon mapping: right where disks of any size are, better with each sample elsewhere, and the light of caustics is found.
#include "render/comparison/progressive_photon_map.h"

#include "measure/convergence/reference.h"
#include "measure/statistics/bias_test.h"
#include "measure/statistics/intervals.h"
#include "tests/render/comparison/comparison_images.h"

#include <cmath>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

TEST(ProgressivePhotonMap, RadiusFollowsItsRecursion) {
    double squared = 0.25;
    for (int i = 1; i < 100; ++i) squared *= (i + 0.6) / (i + 1);
    EXPECT_NEAR(progressive_radius(0.5, 0.6, 99), std::sqrt(squared), 1e-14);
    EXPECT_EQ(progressive_radius(0.5, 0.6, 0), 0.5);
    EXPECT_EQ(progressive_radius(0.5, 1, 1000), 0.5);
}

TEST(ProgressivePhotonMap, IsRightInTheMiddleOfGlowingWalls) {
    EXPECT_TRUE(is_mean(integrator_mean(glowing_walls(), settings_for(8, 8, 4), "progressive-photon-map,photons=10000,radius=0.2"), 2));
}

// Half of a disk at the edge of a wall lies beside it: the image is too dark by an amount that falls with the radius, so with the samples.
TEST(ProgressivePhotonMap, BiasFallsWithTheSamples) {
    Scene room = glowing_walls();
    room.view = looking({0, 0, 0.9f}, {0, 0, 0}, 1);
    std::vector<double> samples, dark;
    for (const int spp : {2, 8, 32, 128}) {
        const Measured image =
            integrator_mean(room, settings_for(8, 8, spp), "progressive-photon-map,photons=2000,radius=0.3,alpha=0.5", 4);
        samples.push_back(spp);
        dark.push_back(2 - image.mean.x);
        EXPECT_GT(dark.back(), 0) << spp;
    }
    const PowerFit fitted = fit_power(samples, dark);
    EXPECT_LT(fitted.slope.high, 0) << fitted.slope.value;
}

// Direct light, too, comes from photons: of lights with and without a size and of the sky.
TEST(ProgressivePhotonMap, AgreesWithPathTracingForEachKindOfLight) {
    Scene room;
    place(room, cube(true), lambert(0.7f));
    room.view = looking({0, 0, 0.9f}, {0, 0, -1}, 0.1f);
    Scene spot = room, bulb = room, window;
    place_light(spot, {.kind = Light::Kind::spot, .intensity = 5}, aimed({0, 0.5f, 0}, {0, -1, 0}));
    place_light(bulb, {.kind = Light::Kind::sphere, .intensity = 5, .radius = 0.1f}, at({0, 0, 0.5f}));
    place(window, floor_quad(1, -0.5f), lambert(0.7f));
    place(window, ceiling_quad(1, 0.5f), lambert(0.7f));
    constant_world(window, 1);
    window.view = looking({0, 0, 0}, {0, -0.5f, 0.001f}, 0.1f);
    RenderSettings few = settings_for(8, 8, 4), many = settings_for(8, 8, 64);
    few.mis_compensation = many.mis_compensation = true; // light sampling leaves the sky to BSDF sampling
    for (const auto& [name, scene] : {std::pair{"spot", &spot}, {"bulb", &bulb}, {"window", &window}})
        EXPECT_TRUE(same_mean(integrator_mean(*scene, few, "progressive-photon-map,photons=30000,radius=0.02"),
                              integrator_mean(*scene, many, "path"), sidak(significance, 3)))
            << name;
}

TEST(ProgressivePhotonMap, HasTheLightOfAParallelSun) {
    Scene scene;
    place(scene, floor_quad(1), lambert(0.7f));
    place_light(scene, {.kind = Light::Kind::sun, .intensity = 3}, aimed({0, 5, 0}, {0, -1, 0}));
    scene.view = looking_down(0.2f, 1);
    EXPECT_TRUE(is_mean(integrator_mean(scene, settings_for(8, 8, 4), "progressive-photon-map,photons=30000,radius=0.05"),
                        3 * 0.7 / std::numbers::pi));
}

// Glossy, coated and transmitting surfaces scatter photons towards the camera by their whole BSDF; mirrors pass the path on.
TEST(ProgressivePhotonMap, AgreesWithPathTracingForEachKindOfSurface) {
    Material rough = plastic(0.5f), mirror = plastic(0);
    rough.metallic = mirror.metallic = 1;
    Material coated = plastic(0.2f);
    for (const auto& [name, material] : {std::pair{"rough metal", &rough}, {"plastic", &coated}, {"mirror", &mirror}}) {
        Scene scene;
        place(scene, cube(true), emitter(1, 0.5f));
        place(scene, floor_quad(0.3f, -0.5f), *material);
        scene.view = looking({0, 0.2f, 0.2f}, {0, -0.5f, 0}, 0.1f);
        EXPECT_TRUE(same_mean(integrator_mean(scene, settings_for(8, 8, 4), "progressive-photon-map,photons=30000,radius=0.05", 8),
                              integrator_mean(scene, settings_for(8, 8, 256), "path", 8), sidak(significance, 3)))
            << name;
    }
}

// Pixels share photons: what they have in common counts in the error of a region's mean.
TEST(ProgressivePhotonMap, BiasTestKnowsThatPixelsSharePhotons) {
    const Scene scene = glowing_walls();
    RenderSettings settings = settings_for(64, 64, 1024);
    settings.seed = 1000;
    const MeasuredImage reference = measured_image(*integrator_render(scene, settings, "path"));
    settings.spp = 8;
    int rejected = 0, rejected_as_independent = 0;
    for (settings.seed = 0; settings.seed < 20; ++settings.seed) {
        MeasuredImage image = measured_image(*integrator_render(scene, settings, "progressive-photon-map,photons=5000,radius=0.05"));
        rejected += test_bias(image, reference).biased;
        image.variance_factor = 1;
        rejected_as_independent += test_bias(image, reference).biased;
    }
    EXPECT_LE(rejected, 3); // of 20 at a level of 0.01, 4 are rejected with probability 4e-5
    EXPECT_GT(rejected_as_independent, 10);
}

TEST(ProgressivePhotonMap, DoesNotDependOnHowSamplesAreSplit) {
    const Scene scene = shipped_scene("cornell");
    const RenderSettings settings = settings_for(16, 16, 4);
    const auto parts = integrator_renderer(scene, settings, "progressive-photon-map,photons=1000");
    parts->render(0, 1);
    parts->render(1, 3);
    EXPECT_EQ(parts->resolve().rgba, integrator_frame(scene, settings, "progressive-photon-map,photons=1000").rgba);
}

TEST(ProgressivePhotonMap, FollowsTheLimitOfBounces) {
    const Scene scene = shipped_scene("cornell");
    RenderSettings settings = settings_for(16, 16, 4);
    settings.max_bounces = 0;
    EXPECT_EQ(integrator_frame(scene, settings, "progressive-photon-map").rgba, integrator_frame(scene, settings, "path").rgba);
    // Photons of direct light alone, and one reflection more: half as much each time in a glowing room.
    for (const int bounces : {1, 2, 3}) {
        settings = settings_for(8, 8, 4);
        settings.max_bounces = bounces;
        EXPECT_TRUE(is_mean(integrator_mean(glowing_walls(), settings, "progressive-photon-map,photons=10000,radius=0.2"),
                            2 - std::pow(0.5, bounces), sidak(significance, 3)))
            << bounces;
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
