// Light meters against closed forms, and the coverage of their intervals.
#include "core/math.h"
#include "measure/metrics/light_meter.h"
#include "scene/affine.h"
#include "tests/render/irradiance.h"

#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int rounds = 256, samples = 32;

MeterReading reading(const Scene& scene, const MeterPlace& place, const RenderSettings& settings = settings_for(1, 1, 1),
                     int count = rounds) {
    LightMeters meters({.threads = 1});
    meters.begin(scene, settings, std::span(&place, 1));
    for (int i = 0; i < count; ++i) EXPECT_TRUE(meters.round(samples));
    EXPECT_EQ(meters.readings().at(0).rounds, count);
    return meters.readings()[0];
}

// True if the illuminance is `lux`; without noise, up to rounding.
testing::AssertionResult reads(const MeterReading& r, double lux) {
    const double error = (r.lux.high - r.lux.low) / 2 / student_95(r.rounds - 1);
    return statistics::z_verdict("illuminance", r.lux.value - lux, std::max(error, 1e-5 * lux), lux, statistics::significance);
}

const MeterPlace floor_place{{0.2, 0, -0.1}, {0, 1, 0}, 0}, on_a_floor{{0.2, 0, -0.1}, {0, 1, 0}, 1e-4};

TEST(LightMeter, ReadsAPointAndASun) {
    Scene scene;
    Light point;
    point.kind = Light::Kind::point;
    point.intensity = 5;
    place_light(scene, point, at({1, 2, 0.5f}));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 3;
    place_light(scene, sun, aimed({0, 5, 0}, {1, -1, 0.5f}));
    const Vec3d to = Vec3d{1, 2, 0.5} - floor_place.position;
    const double expected = 5 * to.y / std::pow(length(to), 3) + 3 / std::sqrt(2.25);
    EXPECT_TRUE(reads(reading(scene, floor_place), expected));
}

// Without noise.
TEST(LightMeter, ReadsALampThroughBlendedSheets) {
    Scene scene;
    Material sheet = lambert(0.f);
    sheet.alpha = Material::Alpha::blend;
    sheet.opacity = 0.3f;
    for (int i = 0; i < 3; ++i) place(scene, floor_quad(50, 0.5f + 0.1f * float(i)), sheet);
    Light point;
    point.intensity = 5;
    place_light(scene, point, at({1, 2, 0.5f}));
    const Vec3d to = Vec3d{1, 2, 0.5} - floor_place.position;
    const double expected = 5 * to.y / std::pow(length(to), 3) * std::pow(1 - double(0.3f), 3);
    const MeterReading r = reading(scene, floor_place, settings_for(1, 1, 1), 4);
    EXPECT_TRUE(reads(r, expected));
    EXPECT_LT(r.lux.high - r.lux.low, 1e-6 * expected);
}

struct LitPlace {
    Scene scene;
    double lux; // at floor_place
};
LitPlace under_a_rectangle_light() {
    Light light;
    light.kind = Light::Kind::rectangle;
    light.intensity = 4;
    light.width = 1;
    light.height = 0.5f;
    const Transform transform = aimed({0.5f, 1.2f, 0.3f}, {-0.2f, -1, 0.1f});
    LitPlace lit;
    place_light(lit.scene, light, transform);
    lit.lux = 4 * polygon_irradiance(floor_place.position, {0, 1, 0}, rectangle_corners(light, transform));
    return lit;
}

TEST(LightMeter, ReadsARectangleLight) {
    const auto [scene, expected] = under_a_rectangle_light();
    for (const Strategy strategy : {Strategy::mis, Strategy::light, Strategy::bsdf}) {
        RenderSettings settings = settings_for(1, 1, 1);
        settings.strategy = strategy;
        EXPECT_TRUE(reads(reading(scene, floor_place, settings), expected)) << int(strategy);
    }
}

TEST(LightMeter, ReadsTheSkyFromAnySideOfItself) {
    Scene scene;
    constant_world(scene, 0.7f);
    EXPECT_TRUE(reads(reading(scene, floor_place), 0.7 * pi));
    EXPECT_TRUE(reads(reading(scene, {{0, 0, 0}, normalize(Vec3d{1, -2, 0.5}), 0}), 0.7 * pi));
}

// Above a floor only half of the sky is visible; light reflected by the floor does not reach a meter on it.
TEST(LightMeter, SeesOccludersAndReflectedLight) {
    Scene scene;
    constant_world(scene, 1);
    place(scene, floor_quad(50), lambert(0.5f));
    EXPECT_TRUE(reads(reading(scene, on_a_floor), pi));
    place(scene, ceiling_quad(50, 1), lambert(0));
    const MeterReading dark = reading(scene, on_a_floor);
    EXPECT_LT(dark.lux.value, 0.01 * pi) << "under a black ceiling";
}

// A closed room whose walls emit 1 nit with albedo 1/2: radiance 1 / (1 - 1/2) everywhere.
TEST(LightMeter, CountsLightThatWasReflectedManyTimes) {
    Scene scene;
    place(scene, cube(true), emitter(1, 0.5f));
    EXPECT_TRUE(reads(reading(scene, {{0.3, -1, 0.2}, {0, 1, 0}, 1e-4}), 2 * pi));
    RenderSettings direct = settings_for(1, 1, 1);
    direct.max_bounces = 1;
    EXPECT_TRUE(reads(reading(scene, {{0.3, -1, 0.2}, {0, 1, 0}, 1e-4}, direct), pi));
}

// Of many readings, 95 % contain the true value; the allowed deviation is binomial.
TEST(LightMeter, IntervalsHaveTheirNominalCoverage) {
    const auto [scene, expected] = under_a_rectangle_light();
    constexpr int readings = 400;
    int held = 0;
    for (int i = 0; i < readings; ++i) {
        RenderSettings settings = settings_for(1, 1, 1);
        settings.seed = uint32_t(i);
        const Interval lux = reading(scene, floor_place, settings, 16).lux;
        held += lux.low <= expected && expected <= lux.high;
    }
    EXPECT_NEAR(held, 0.95 * readings, 4 * std::sqrt(readings * 0.95 * 0.05));
}

TEST(LightMeter, DoesNotDependOnThreadsOrTouchTheFilm) {
    const Scene scene = shipped_scene("cornell");
    Renderer one({.threads = 1}), two({.threads = 2});
    one.update(scene, settings_for(16, 16, 1));
    two.update(scene, settings_for(16, 16, 1));
    one.render(0, 1);
    const std::vector<float> before = one.resolve().rgba;
    const MeterPlace place{{0.4, 0.001, 0.1}, {0, 1, 0}, 1e-4};
    EXPECT_EQ(one.irradiance(place, 3, 64), two.irradiance(place, 3, 64));
    EXPECT_NE(one.irradiance(place, 3, 64), one.irradiance(place, 4, 64));
    EXPECT_EQ(one.resolve().rgba, before);
}

// A fresh renderer, and one after an edit.
TEST(LightMeter, FollowsEdits) {
    Scene scene;
    Light point;
    point.kind = Light::Kind::point;
    point.intensity = 5;
    const Id<Node> node = place_light(scene, point, at({0, 2, 0}));
    LightMeters meters({.threads = 1});
    const MeterPlace place{{0, 0, 0}, {0, 1, 0}, 0};
    meters.begin(scene, settings_for(1, 1, 1), std::span(&place, 1));
    meters.round(samples);
    EXPECT_NEAR(meters.readings()[0].lux.value, 5 / 4.0, 1e-5);
    Node moved = *scene.nodes.find(node);
    moved.local = at({0, 1, 0});
    scene.nodes.set(node, moved);
    meters.begin(scene, settings_for(1, 1, 1), std::span(&place, 1));
    meters.round(samples);
    EXPECT_NEAR(meters.readings()[0].lux.value, 5, 1e-4);
}

} // namespace
} // namespace blush::test::TEST_FILE
