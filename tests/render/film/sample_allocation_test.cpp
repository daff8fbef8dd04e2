// Sample allocation for hand-made noise.
#include "render/film/sample_allocation.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace blush::test::TEST_FILE {
namespace {

constexpr int64_t pilot = SampleAllocation::pilot_samples;

SampleAllocation plan_of(int width, int height) {
    SampleAllocation plan;
    plan.reset(width, height);
    return plan;
}

// Mean number of samples of a half over the pixels.
double mean_samples(const SampleAllocation& plan, int width, int height, int half, int64_t mean) {
    int64_t sum = 0;
    for (int t = 0; t < plan.tiles(); ++t) {
        const int x = t % plan.across() * SampleAllocation::tile_size, y = t / plan.across() * SampleAllocation::tile_size;
        sum += plan.samples(t, half, mean) * std::min(SampleAllocation::tile_size, width - x) *
               std::min(SampleAllocation::tile_size, height - y);
    }
    return double(sum) / (double(width) * height);
}

TEST(SampleAllocation, ThePilotIsUniform) {
    const SampleAllocation plan = plan_of(70, 40);
    EXPECT_EQ(plan.tiles(), 5 * 3);
    EXPECT_FALSE(plan.decided());
    for (int t = 0; t < plan.tiles(); ++t)
        for (int64_t n = 0; n <= pilot; ++n) {
            EXPECT_EQ(plan.samples(t, 0, n), (n + 1) / 2);
            EXPECT_EQ(plan.samples(t, 1, n), n / 2);
        }
}

TEST(SampleAllocation, StopsInTheMiddleAndAtTheEndOfThePilot) {
    EXPECT_EQ(SampleAllocation::next_measurement(0), pilot / 2);
    EXPECT_EQ(SampleAllocation::next_measurement(pilot / 2 - 1), pilot / 2);
    EXPECT_EQ(SampleAllocation::next_measurement(pilot / 2), pilot);
    EXPECT_GT(SampleAllocation::next_measurement(pilot), int64_t(1) << 40);
}

// Noise measured in one half must change only the other half.
TEST(SampleAllocation, HalvesDecideForEachOther) {
    SampleAllocation plan = plan_of(64, 64);
    TileNoise a(16, 1), b(16, 1);
    a[3] = 4;
    plan.decide({a, b});
    ASSERT_TRUE(plan.decided());
    EXPECT_GT(plan.samples(3, 1, 128), 2 * plan.samples(2, 1, 128));
    for (int t = 0; t < 16; ++t) EXPECT_NEAR(double(plan.samples(t, 0, 128)), 64, double(SampleAllocation::granularity)) << t;
}

TEST(SampleAllocation, SpendsTheGivenSamplesAndNeverDecreases) {
    constexpr int width = 250, height = 130; // with tiles cut at the edges
    SampleAllocation plan = plan_of(width, height);
    std::array<TileNoise, 2> noise;
    for (int half = 0; half < 2; ++half)
        for (int t = 0; t < plan.tiles(); ++t) noise[size_t(half)].push_back(double((t * 37 + half * 11) % 23) * 0.1);
    noise[0][5] = 1e6; // a firefly
    plan.decide(noise);
    for (int half = 0; half < 2; ++half)
        for (const int64_t mean : {pilot, pilot + 1, pilot + 20, int64_t(64), int64_t(1000), int64_t(1) << 30})
            EXPECT_NEAR(mean_samples(plan, width, height, half, mean), double(mean) / 2, 0.25 * double(SampleAllocation::granularity))
                << mean;
    for (int t = 0; t < plan.tiles(); ++t)
        for (int64_t mean = 0; mean < 200; ++mean) ASSERT_LE(plan.samples(t, 0, mean), plan.samples(t, 0, mean + 1));
}

TEST(SampleAllocation, SharesStayWithinTheirLimits) {
    SampleAllocation plan = plan_of(160, 160);
    TileNoise noise(100, 1);
    noise[42] = 1e9;
    noise[17] = 0;
    plan.decide({noise, noise});
    const int64_t n = pilot + 10000;
    const double after = 5000;
    const double rounding = double(pilot / 2 + SampleAllocation::granularity);
    EXPECT_NEAR(double(plan.samples(42, 0, n)), SampleAllocation::max_share * after, rounding);
    EXPECT_NEAR(double(plan.samples(17, 0, n)), SampleAllocation::min_share * after, rounding);
    EXPECT_NEAR(mean_samples(plan, 160, 160, 0, n), double(n) / 2, 2);
}

TEST(SampleAllocation, WithoutNoiseSharesAreEqual) {
    SampleAllocation plan = plan_of(40, 40);
    plan.decide({TileNoise(9, 0), TileNoise(9, 0)});
    for (int t = 0; t < 9; ++t) EXPECT_NEAR(double(plan.samples(t, 0, 1016)), 508, double(SampleAllocation::granularity));
}

// So few tiles are noisy that the limits would leave samples over.
TEST(SampleAllocation, SamplesLeftOverByTheLimitsAreDistributed) {
    SampleAllocation plan = plan_of(160, 160);
    TileNoise noise(100, 0);
    noise[0] = 1;
    plan.decide({noise, noise});
    EXPECT_NEAR(mean_samples(plan, 160, 160, 1, 10016), 5008, 2);
}

} // namespace
} // namespace blush::test::TEST_FILE
