// Bidirectional path tracing: its weights add up to 1, and it agrees with path tracing for all kinds of lights, surfaces and paths.
#include "measure/statistics/intervals.h"
#include "render/comparison/path_densities.h"
#include "tests/render/comparison/comparison_images.h"

#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

// Densities over area of all vertices but the camera, as section 10.2 of Veach 1997 writes them.
double area_density(const PathDensities& d, int s) {
    double p = 1;
    for (int i = std::max(s, 1); i < d.edges; ++i) p *= d.toward_light[size_t(i)] * d.geometry[size_t(i)];
    if (s == 0) return p * d.toward_light[0];
    if (s == 1) return p * d.nee;
    p *= d.emission;
    for (int i = 1; i <= s - 2; ++i) p *= d.toward_camera[size_t(i)] * d.geometry[size_t(i)];
    return s == d.edges ? p * d.light_paths : p;
}

PathDensities any_densities(std::mt19937& random, int edges, double delta_share) {
    std::lognormal_distribution<double> density(0, 2);
    std::bernoulli_distribution is_delta(delta_share), is_point(0.3);
    PathDensities d;
    d.edges = edges;
    for (size_t i = 0; i < size_t(PathDensities::size); ++i) {
        d.toward_camera[i] = density(random);
        d.toward_light[i] = density(random);
        d.geometry[i] = int(i) == edges - 1 ? 1 : density(random);
        d.delta[i] = is_delta(random);
    }
    d.nee = density(random);
    d.emission = density(random);
    d.light_can_be_hit = !is_point(random);
    d.light_paths = 4096;
    return d;
}

TEST(PathDensities, WeightsOfAllStrategiesAddUpToOne) {
    std::mt19937 random(1);
    int checked = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const PathDensities d = any_densities(random, 2 + trial % 24, trial % 3 == 0 ? 0.4 : 0);
        double sum = 0;
        int possible = 0;
        for (int s = 0; s <= d.edges; ++s)
            if (d.possible(s)) sum += d.weight(s), ++possible;
        if (possible == 0) continue;
        ++checked;
        EXPECT_NEAR(sum, 1, 1e-9) << d.edges;
    }
    EXPECT_GT(checked, 1500);
}

TEST(PathDensities, WeightsFollowThePowerHeuristic) {
    std::mt19937 random(2);
    for (int trial = 0; trial < 500; ++trial) {
        const PathDensities d = any_densities(random, 2 + trial % 8, trial % 3 == 0 ? 0.3 : 0);
        double sum = 0;
        for (int s = 0; s <= d.edges; ++s)
            if (d.possible(s)) sum += std::pow(area_density(d, s), 2);
        for (int s = 0; s <= d.edges; ++s) {
            if (!d.possible(s)) continue;
            EXPECT_NEAR(d.weight(s), std::pow(area_density(d, s), 2) / sum, 1e-9) << s << " of " << d.edges;
        }
    }
}

TEST(PathDensities, ExtremesHaveFiniteWeights) {
    for (const double extreme : {1e-300, 1e-30, 1e30, 1e300}) {
        std::mt19937 random(3);
        PathDensities d = any_densities(random, 12, 0);
        d.light_can_be_hit = true;
        for (size_t i = 0; i < size_t(PathDensities::size); i += 2) d.geometry[i] = extreme;
        for (int s = 0; s <= d.edges; ++s) {
            const double w = d.weight(s);
            EXPECT_TRUE(w >= 0 && w <= 1) << w;
        }
    }
}

TEST(PathDensities, LightPathsHaveALimitedNumberOfSurfaces) {
    std::mt19937 random(4);
    const PathDensities d = any_densities(random, 60, 0);
    EXPECT_TRUE(d.possible(PathDensities::max_light_vertices + 1));
    EXPECT_FALSE(d.possible(PathDensities::max_light_vertices + 2));
    EXPECT_FALSE(d.possible(60)) << "no light path reaches the camera";
}

TEST(Bidirectional, IsRightBetweenGlowingWalls) {
    Scene room = glowing_walls();
    room.view = looking({0, 0, 0.9f}, {0, 0, 0}, 1); // with edges
    EXPECT_TRUE(is_mean(integrator_mean(room, settings_for(8, 8, 16), "bidirectional"), 2));
}

TEST(Bidirectional, FollowsTheLimitOfBounces) {
    RenderSettings settings = settings_for(8, 8, 16);
    settings.max_bounces = 0;
    EXPECT_EQ(integrator_frame(glowing_walls(), settings, "bidirectional").rgba, integrator_frame(glowing_walls(), settings, "path").rgba);
    for (const int bounces : {1, 2, 3}) {
        settings.max_bounces = bounces;
        EXPECT_TRUE(
            is_mean(integrator_mean(glowing_walls(), settings, "bidirectional"), 2 - std::pow(0.5, bounces), sidak(significance, 3)))
            << bounces;
    }
}

Scene room_with(const Light& light, const Transform& transform) {
    Scene room;
    place(room, cube(true), lambert({0.8f, 0.6f, 0.4f}));
    room.view = looking({0, 0, 0.9f}, {0, -0.3f, -1}, 0.8f);
    place_light(room, light, transform);
    return room;
}

std::vector<std::pair<const char*, Scene>> lit_rooms() {
    Scene window;
    place(window, floor_quad(1, -0.5f), lambert(0.7f));
    place(window, ceiling_quad(1, 0.5f), lambert(0.7f));
    constant_world(window, 1);
    window.view = looking({0, 0, 0}, {0, -0.5f, 0.001f}, 0.5f);
    Scene sunny = window;
    Light sun{.kind = Light::Kind::sun, .intensity = 3};
    sun.angle_radians = 0.3f;
    place_light(sunny, sun, aimed({0, 5, 0}, {0.8f, -0.4f, 0.1f}));
    const Transform down = aimed({0.2f, 0.6f, 0}, {0, -1, 0});
    Light panel{.kind = Light::Kind::rectangle, .intensity = 5};
    panel.width = panel.height = 0.4f;
    return {{"point", room_with({.kind = Light::Kind::point, .intensity = 5}, at({0, 0.3f, 0}))},
            {"spot", room_with({.kind = Light::Kind::spot, .intensity = 5}, down)},
            {"bulb", room_with({.kind = Light::Kind::sphere, .intensity = 5, .radius = 0.1f}, at({0, 0, 0}))},
            {"rectangle", room_with(panel, down)},
            {"sky", window},
            {"sky and sun", sunny}};
}

TEST(Bidirectional, AgreesWithPathTracingForEachKindOfLight) {
    RenderSettings few = settings_for(16, 16, 16), many = settings_for(16, 16, 64);
    for (const auto& [name, scene] : lit_rooms())
        EXPECT_TRUE(same_mean(integrator_mean(scene, few, "bidirectional"), integrator_mean(scene, many, "path"), sidak(significance, 6)))
            << name;
}

// A box of the surface in a glowing room: all light that it scatters, reflects and refracts is seen by both.
TEST(Bidirectional, AgreesWithPathTracingForEachKindOfSurface) {
    Material coated = metal(0.3f), sheet = gel({0.9f, 0.5f, 0.3f}), amber = glass(0.3f, 1.4f);
    coated.clearcoat = 1;
    amber.attenuation_color = {0.9f, 0.5f, 0.2f};
    amber.attenuation_distance = 0.3f;
    const std::vector<std::pair<const char*, Material>> surfaces{
        {"mirror", metal(0)},      {"rough metal", metal(0.3f)},       {"plastic", plastic(0.2f)}, {"smooth plastic", plastic(0)},
        {"glass", glass(0, 1.5f)}, {"rough glass", glass(0.3f, 1.5f)}, {"coated", coated},         {"thin sheet", sheet},
        {"absorbing glass", amber}};
    for (const auto& [name, material] : surfaces) {
        Scene scene;
        Light bulb{.kind = Light::Kind::sphere, .intensity = 5, .radius = 0.3f};
        place(scene, cube(true), lambert(0.7f));
        place_light(scene, bulb, at({0.4f, 0.5f, 0.2f}));
        place(scene, sphere(false), material, at({-0.3f, -0.5f, -0.2f}, 0.4f));
        scene.view = looking({0, 0.2f, 0.9f}, {-0.1f, -0.4f, 0}, 1);
        EXPECT_TRUE(same_mean(integrator_mean(scene, settings_for(16, 16, 32), "bidirectional"),
                              integrator_mean(scene, settings_for(16, 16, 256), "path", 8), sidak(significance, int64_t(surfaces.size()))))
            << name;
    }
}

TEST(Bidirectional, DoesNotDependOnThreadsOrParts) { expect_same_bits_in_parts_and_threads("bidirectional"); }

// Camera paths cannot hit a parallel sun: light paths find its light below a block of glass. With normal incidence the direct beam
// is known: each interface reflects r = ((n - 1) / (n + 1))^2, and what both reflect back and forth sums to (1 - r) / (1 + r).
TEST(Bidirectional, FindsTheCausticOfALightWithoutSize) {
    Scene scene;
    place(scene, floor_quad(0.25f), lambert(0.7f));
    place(scene, cube(false), glass(0, 1.5f), at({0, 1, 0}, 0.5f));
    place_light(scene, {.kind = Light::Kind::sun, .intensity = 3}, aimed({0, 5, 0}, {0, -1, 0}));
    scene.view = looking_down(0.05f, 0.4f); // the floor, from below the block
    const double r = 0.04, beam = 3 * 0.7 / std::numbers::pi * (1 - r) / (1 + r);
    RenderSettings settings = settings_for(8, 8, 64);
    settings.max_bounces = 6; // the floor, and up to five events in the block
    const Measured once = integrator_mean(scene, settings, "bidirectional");
    EXPECT_GT(once.mean.x, beam * 0.99) << "and light that the floor and the block send back and forth";
    EXPECT_LT(once.mean.x, beam * 1.1);
    EXPECT_TRUE(same_mean(integrator_mean(scene, settings, "path", 8), once)) << "light paths of the path tracer find it, too";
}

} // namespace
} // namespace blush::test::TEST_FILE
