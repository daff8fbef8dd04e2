// The strategy comparison: the strategies agree within their measured error, weights sum to 1, times and samples are shared equally, and
// what is not known is not called known.
#include "measure/lab/strategy_comparison.h"

#include "core/math.h"
#include "tests/render/scenes.h"
#include "tests/support/statistics.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr size_t bsdf = 0, light = 1, mis = 2;

Light lamp(Light::Kind kind, float size) {
    Light l;
    l.kind = kind;
    l.radius = size;
    l.width = l.height = size;
    l.intensity = 5;
    return l;
}

// A grey floor below a square light of this side, seen from between them.
Scene lit_floor(float size) {
    Scene scene;
    place(scene, floor_quad(2), lambert(0.5f));
    place_light(scene, lamp(Light::Kind::rectangle, size), aimed({0, 1, 0}, {0, -1, 0}));
    scene.view = looking_down(1, 0.9f);
    return scene;
}

RenderSettings small_image() {
    RenderSettings settings;
    settings.width = 32;
    settings.height = 24;
    settings.filter = PixelFilter::box;
    settings.sampler = SamplerType::random; // samples are independent, so that variances of rounds are those of samples
    return settings;
}

const StrategyReport& compare(StrategyComparison& lab, const Scene& scene, const RenderSettings& settings, int rounds,
                              StrategyBudget budget = StrategyBudget::samples) {
    lab.begin(scene, settings, budget);
    for (int i = 0; i < rounds; ++i) EXPECT_TRUE(lab.round());
    return lab.report();
}

double luminance_at(const StrategySide& side, size_t i) {
    return luminance(Vec3d{double(side.image[i].x), double(side.image[i].y), double(side.image[i].z)});
}

// Mean luminance of a block and its variance.
struct Mean {
    double value = 0, variance = 0;
};
Mean block_mean(const StrategySide& side, int width, int x0, int y0, int size) {
    Mean m;
    for (int y = y0; y < y0 + size; ++y)
        for (int x = x0; x < x0 + size; ++x) {
            const size_t i = size_t(y * width + x);
            m.value += luminance_at(side, i);
            m.variance += double(side.variance[i]) / double(side.samples);
        }
    const double n = size * size;
    return {m.value / n, m.variance / (n * n)};
}

TEST(StrategyComparison, StrategiesAgreeWithinTheirError) {
    StrategyComparison lab({.threads = 1});
    const StrategyReport& r = compare(lab, lit_floor(1), small_image(), 40);
    ASSERT_EQ(r.width, 32);
    ASSERT_EQ(r.height, 24);
    const int size = 8, tests = 2 * (r.width / size) * (r.height / size);
    for (const size_t other : {bsdf, light})
        for (int y = 0; y < r.height; y += size)
            for (int x = 0; x < r.width; x += size) {
                const Mean a = block_mean(r.sides[other], r.width, x, y, size), b = block_mean(r.mis(), r.width, x, y, size);
                ASSERT_GT(b.value, 0);
                EXPECT_TRUE(z_verdict("the means differ", a.value - b.value, std::sqrt(a.variance + b.variance), b.value,
                                      sidak(significance, tests)))
                    << "strategy " << other << " at " << x << ", " << y;
            }
}

// For independent samples, the error of an image is the root of its variance: the errors come from half buffers and from the image of
// MIS, the variances from rounds.
TEST(StrategyComparison, ErrorsAreThoseOfTheVariances) {
    StrategyComparison lab({.threads = 1});
    const StrategyReport& r = compare(lab, lit_floor(0.5f), small_image(), 40);
    for (size_t k = 0; k < r.sides.size(); ++k) {
        const StrategySide& side = r.sides[k];
        const Interval rmse = side.error(ErrorMetric::rmse);
        ASSERT_TRUE(rmse.known) << k;
        double variance = 0;
        for (const float v : side.variance) variance += double(v) / double(side.variance.size());
        const double samples = double(side.record.points().back().spp), expected = std::sqrt(variance / samples);
        // Both have errors: the interval of the first, and of the second about as much.
        EXPECT_GT(expected, rmse.low * rmse.low / rmse.value) << k;
        EXPECT_LT(expected, rmse.high * rmse.high / rmse.value) << k;
    }
    // A small light: rays that meet it by chance are rarer than those aimed at it. MIS is as good as the better one.
    const auto rmse = [&](size_t k) { return r.sides[k].error(ErrorMetric::rmse); };
    EXPECT_GT(rmse(bsdf).low, rmse(light).high);
    EXPECT_GT(rmse(bsdf).low, rmse(mis).high);
}

TEST(StrategyComparison, WeightsSumToOne) {
    StrategyComparison lab({.threads = 1});
    const StrategyReport& r = compare(lab, lit_floor(2), small_image(), 3);
    EXPECT_NEAR(r.parts[0].share + r.parts[1].share, 1, float_rounding);
    EXPECT_GT(r.parts[0].share, 0.05);
    EXPECT_GT(r.parts[1].share, 0.05);
    size_t lit = 0;
    for (size_t i = 0; i < r.mis().image.size(); ++i) {
        const float a = r.parts[0].weight[i], b = r.parts[1].weight[i];
        EXPECT_GE(a, 0);
        EXPECT_GE(b, 0);
        if (luminance_at(r.mis(), i) == 0) {
            EXPECT_EQ(a + b, 0) << i;
            continue;
        }
        ++lit;
        EXPECT_NEAR(a + b, 1, float_rounding) << i;
    }
    EXPECT_GT(lit, r.mis().image.size() / 4);
    for (const MisPart& part : r.parts) EXPECT_EQ(part.variance.size(), r.mis().image.size());
}

TEST(StrategyComparison, SharesTimeInWholeSamples) {
    StrategyComparison lab({.threads = 1});
    lab.begin(lit_floor(1), small_image(), StrategyBudget::time);
    for (int round = 1; round <= 5; ++round) {
        ASSERT_TRUE(lab.round());
        const StrategyReport& r = lab.report();
        double most = 0, least = 1e9, sample = 0;
        for (const StrategySide& side : r.sides) {
            most = std::max(most, side.seconds);
            least = std::min(least, side.seconds);
            sample = std::max(sample, side.seconds / double(side.samples));
        }
        EXPECT_GE(least, round * strategy_round_seconds);
        // Other work on the machine can make a sample take several times the mean.
        EXPECT_LE(most - least, 8 * sample) << "round " << round;
    }
}

TEST(StrategyComparison, SharesSamples) {
    StrategyComparison lab({.threads = 1});
    const StrategyReport& r = compare(lab, lit_floor(1), small_image(), 5);
    for (const StrategySide& side : r.sides) EXPECT_EQ(side.samples, 5 * strategy_round_samples);
}

TEST(StrategyComparison, DoesNotDependOnThreads) {
    StrategyComparison one({.threads = 1}), three({.threads = 3});
    const StrategyReport &a = compare(one, lit_floor(1), small_image(), 3), &b = compare(three, lit_floor(1), small_image(), 3);
    for (size_t k = 0; k < a.sides.size(); ++k) {
        EXPECT_EQ(a.sides[k].image, b.sides[k].image) << k;
        EXPECT_EQ(a.sides[k].variance, b.sides[k].variance) << k;
        EXPECT_EQ(a.sides[k].error(ErrorMetric::relmse).value, b.sides[k].error(ErrorMetric::relmse).value) << k;
    }
    for (size_t k = 0; k < a.parts.size(); ++k) {
        EXPECT_EQ(a.parts[k].weight, b.parts[k].weight) << k;
        EXPECT_EQ(a.parts[k].variance, b.parts[k].variance) << k;
    }
}

// No ray hits a point light: NEE finds it in all three images, so that MIS has nothing to combine.
TEST(StrategyComparison, CountsLightsWithoutSize) {
    Scene scene;
    place(scene, floor_quad(2), lambert(0.5f));
    scene.view = looking({2, 2, 2}, {0, 0, 0}, 0.8f);
    place_light(scene, lamp(Light::Kind::point, 0), aimed({0, 1, 0}, {0, -1, 0}));
    place_light(scene, lamp(Light::Kind::spot, 0), aimed({1, 1, 0}, {0, -1, 0}));
    Light off = lamp(Light::Kind::point, 0);
    off.enabled = false;
    place_light(scene, off, aimed({0, 1, 1}, {0, -1, 0}));
    StrategyComparison lab({.threads = 1});
    EXPECT_EQ(compare(lab, lit_floor(1), small_image(), 1).zero_size_lights, 0);
    const StrategyReport& r = compare(lab, scene, small_image(), 2);
    EXPECT_EQ(r.zero_size_lights, 2);
    EXPECT_EQ(r.rounds, 2);
    EXPECT_NEAR(r.parts[1].share, 1, float_rounding);
    for (const StrategySide& side : r.sides) EXPECT_GT(luminance_at(side, 12 * 32 + 16), 0);
}

TEST(StrategyComparison, DoesNotKnowTheErrorOfABlackImage) {
    Scene scene;
    place(scene, floor_quad(2), lambert(0.5f));
    scene.view = looking({2, 2, 2}, {0, 0, 0}, 0.8f);
    StrategyComparison lab({.threads = 1});
    const StrategyReport& r = compare(lab, scene, small_image(), 3);
    for (const StrategySide& side : r.sides)
        for (const ErrorMetric metric : {ErrorMetric::rmse, ErrorMetric::relmse}) EXPECT_FALSE(side.error(metric).known);
    for (const MisPart& part : r.parts) EXPECT_EQ(part.share, 0);
}

TEST(StrategyComparison, StopsAndScales) {
    RenderSettings settings = small_image();
    settings.width = 1200;
    settings.height = 600;
    StrategyComparison lab({.threads = 1});
    lab.begin(lit_floor(1), settings, StrategyBudget::time, 60);
    EXPECT_EQ(lab.report().width, 60);
    EXPECT_EQ(lab.report().height, 30);
    EXPECT_FALSE(lab.round([] { return false; }));
    EXPECT_EQ(lab.report().rounds, 0);
}

} // namespace
} // namespace blush::test::TEST_FILE
