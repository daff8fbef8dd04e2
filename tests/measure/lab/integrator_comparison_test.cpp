// The comparison of a biased integrator with path tracing: a known bias is measured and found, none is invented, the time is shared with
// the preparation counted.
#include "measure/lab/integrator_comparison.h"

#include "measure/statistics/significance.h"
#include "tests/render/scenes.h"
#include "tests/support/statistics.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

RenderSettings small_image() {
    RenderSettings settings;
    settings.width = 32;
    settings.height = 24;
    return settings;
}

// Walls that emit 1 nit and reflect half: radiance 1 / (1 - 0.5) = 2 everywhere, 1.5 without what is reflected twice and more.
Scene glowing_room() {
    Scene scene;
    place(scene, cube(true), emitter(1, 0.5f));
    scene.view = looking({0, 0, 0.9f}, {0, 0, 0}, 1);
    return scene;
}

// How many rounds fit in a time differs between runs: tests hold with near certainty for any number.
constexpr double rare = 1e-6;

const IntegratorReport& compare(IntegratorComparison& lab, const Scene& scene, const std::string& integrator, int rounds) {
    lab.begin(scene, small_image(), *parse_integrator(integrator));
    for (int i = 0; i < rounds; ++i) EXPECT_TRUE(lab.round());
    return lab.report();
}

TEST(IntegratorComparison, MeasuresAKnownBias) {
    IntegratorComparison lab({.threads = 1});
    const IntegratorReport& r = compare(lab, glowing_room(), "ambient,color=0:0:0", 3);
    ASSERT_EQ(r.width, 32);
    ASSERT_EQ(r.path.image.size(), size_t(32 * 24));
    // Black ambient light leaves out half a nit of two.
    const double lost = 0.5, whole = 2;
    EXPECT_TRUE(r.verdict.biased);
    EXPECT_TRUE(z_verdict("the loss", r.verdict.whole.percent() / 100 + lost / whole, r.verdict.whole.percent_error() / 100, 1, rare));
    for (const RegionBias& region : r.verdict.regions) {
        EXPECT_TRUE(r.verdict.is_biased(region)) << region.x << ", " << region.y;
        EXPECT_LT(region.percent(), 0);
    }
    // Half the width of a 95 % interval is 1.96 standard errors.
    const auto is = [](const Interval& measured, double expected) {
        return measured.known &&
               z_verdict("the bias", measured.value - expected, (measured.high - measured.low) / (2 * 1.96), expected, rare);
    };
    EXPECT_TRUE(is(r.bias_rmse, lost)) << r.bias_rmse.value << " in " << r.bias_rmse.low << " .. " << r.bias_rmse.high;
    EXPECT_TRUE(is(r.bias_relmse, lost * lost / (whole * whole + 0.01))) << r.bias_relmse.value;
}

// The error of the biased image stays, and the noise in it falls.
TEST(IntegratorComparison, ErrorFlattensWhereTheBiasBegins) {
    IntegratorComparison lab({.threads = 1});
    const IntegratorReport& r = compare(lab, glowing_room(), "ambient,color=0:0:0", 6);
    ASSERT_GE(r.error.points().size(), 2u);
    for (const ConvergencePoint& p : r.error.points()) {
        ASSERT_TRUE(p.rmse.known);
        EXPECT_GT(p.rmse.high, 0.5) << "at " << p.spp << " spp";
    }
    ASSERT_TRUE(r.biased.noise_error(ErrorMetric::rmse).known);
    EXPECT_LT(r.biased.noise_error(ErrorMetric::rmse).high, 0.25) << "half buffers do not see the bias";
    EXPECT_LT(r.path.noise_error(ErrorMetric::rmse).value, r.path.noise.points().front().rmse.value);
}

// A room whose lamp is switched off after probes were made: baked, they still hold its light.
TEST(IntegratorComparison, BakedLightGoesStaleWhenTheSceneChanges) {
    Scene room;
    place(room, cube(true), lambert(0.5f));
    room.view = looking({0, 0, 0.9f}, {0, 0, 0}, 1);
    Scene bright = room, dim = room;
    place_light(bright, {.kind = Light::Kind::point, .intensity = 5}, at({0, 0.5f, 0}));
    place_light(dim, {.kind = Light::Kind::point, .intensity = 1}, at({0, 0.5f, 0}));
    // Indirect light is near half of all here: five times as much of it makes the image far too bright.
    const auto excess = [&](const std::string& integrator) {
        IntegratorComparison lab({.threads = 1});
        compare(lab, bright, integrator, 1);
        return compare(lab, dim, integrator, 2).verdict.whole.percent();
    };
    EXPECT_GT(excess("light-probes,grid=8,baked"), 50);
    EXPECT_LT(excess("light-probes,grid=8"), 50);
    EXPECT_GT(excess("irradiance-cache,baked"), 50);
    EXPECT_GT(excess("photon-map,photons=20000,baked"), 50);
    // Another integrator prepares anew.
    IntegratorComparison lab({.threads = 1});
    compare(lab, bright, "light-probes,grid=8,baked", 1);
    EXPECT_LT(compare(lab, dim, "light-probes,grid=9,baked", 2).verdict.whole.percent(), 50);
}

// Without records the irradiance cache traces paths.
TEST(IntegratorComparison, DoesNotInventABias) {
    IntegratorComparison lab({.threads = 1});
    Scene scene;
    place(scene, floor_quad(2), lambert(0.5f));
    place(scene, cube(false), lambert(0.8f), at({0, 0.2f, 0}, 0.2f));
    place_light(scene, {.kind = Light::Kind::sphere, .intensity = 5, .radius = 0.2f}, at({0.5f, 1, 0.5f}));
    scene.view = looking({2, 2, 2}, {0, 0, 0}, 0.8f);
    const IntegratorReport& r = compare(lab, scene, "irradiance-cache,a=0", 5);
    ASSERT_FALSE(r.verdict.regions.empty());
    EXPECT_LT(std::abs(r.verdict.worst.z()), significant_deviate(int(r.verdict.regions.size()) + 2, rare));
}

// What one spends on photons, the other spends on samples: it is never behind after its turn, which alternates.
TEST(IntegratorComparison, SharesTimeWithThePreparation) {
    IntegratorComparison lab({.threads = 1});
    lab.begin(glowing_room(), small_image(), *parse_integrator("photon-map,photons=300000"));
    for (int round = 0; round < 4; ++round) {
        ASSERT_TRUE(lab.round());
        const IntegratorReport& r = lab.report();
        const double first = round % 2 == 0 ? r.biased.seconds : r.path.seconds,
                     second = round % 2 == 0 ? r.path.seconds : r.biased.seconds;
        EXPECT_GE(second, first) << round;
        EXPECT_GE(first, (round + 1) * integrator_round_seconds) << round;
    }
}

TEST(IntegratorComparison, StopsAndScales) {
    RenderSettings settings = small_image();
    settings.width = 1200;
    settings.height = 600;
    IntegratorComparison lab({.threads = 1});
    lab.begin(glowing_room(), settings, *parse_integrator("light-probes"), 60);
    EXPECT_EQ(lab.report().width, 60);
    EXPECT_EQ(lab.report().height, 30);
    EXPECT_FALSE(lab.round([] { return false; }));
    EXPECT_EQ(lab.report().rounds, 0);
    // Begins again after that, with another integrator.
    lab.begin(glowing_room(), settings, *parse_integrator("ambient"), 60);
    EXPECT_TRUE(lab.round());
    EXPECT_EQ(lab.report().rounds, 1);
}

TEST(IntegratorComparison, DoesNotKnowTheErrorOfABlackImage) {
    Scene scene;
    place(scene, floor_quad(2), lambert(0.5f));
    scene.view = looking({2, 2, 2}, {0, 0, 0}, 0.8f);
    IntegratorComparison lab({.threads = 1});
    const IntegratorReport& r = compare(lab, scene, "ambient", 2);
    EXPECT_FALSE(r.verdict.biased);
    for (const ErrorMetric metric : {ErrorMetric::rmse, ErrorMetric::relmse}) {
        EXPECT_FALSE(r.path.noise_error(metric).known);
        EXPECT_FALSE(r.latest_error(metric).known);
        EXPECT_FALSE(r.bias(metric).known);
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
