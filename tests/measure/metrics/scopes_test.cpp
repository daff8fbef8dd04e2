// Scopes count every pixel once, in the right bin.
#include "measure/metrics/scopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace blush::TEST_FILE {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
constexpr ScopeAxis stops{true, -8, 8}, unit{false, 0, 1};

std::vector<float> random_image(int pixels) {
    std::mt19937 rng(11);
    std::normal_distribution<float> exponent(-2, 4);
    std::vector<float> rgb;
    for (int i = 0; i < 3 * pixels; ++i) rgb.push_back(std::exp2(exponent(rng)) - 0.05f);
    return rgb;
}

TEST(Histogram, CountsEveryPixelOnceInEveryChannel) {
    std::vector<float> rgb = random_image(1000);
    rgb[0] = nan;
    rgb[4] = inf;
    rgb[8] = -inf;
    for (const ScopeAxis& axis : {stops, unit}) {
        const Histogram h = histogram(rgb, axis, 77);
        EXPECT_EQ(h.pixels, 1000);
        for (size_t k = 0; k < scope_channels; ++k)
            EXPECT_EQ(std::accumulate(h.counts[k].begin(), h.counts[k].end(), h.below[k] + h.above[k]), 1000) << k;
    }
}

TEST(Histogram, BinsAreWhereTheirValuesAre) {
    // One bin per stop: grey is at a border and belongs to the upper bin.
    const Histogram h = histogram(std::vector<float>{0.18f * 1.01f, 0.18f / 1.5f, 0.18f * 200}, stops, 16);
    EXPECT_EQ(h.counts[0][8], 1u);
    EXPECT_EQ(h.counts[1][7], 1u);
    EXPECT_EQ(h.counts[2][15], 1u);
    EXPECT_EQ(h.counts[3][11], 1u) << "2.7 stops above grey: 0.2127 R + 0.7152 G + 0.0722 B";
    const Histogram ends = histogram(std::vector<float>{0, 1, 1.001f, -0.001f, 0.999f, 0.5f}, unit, 4);
    EXPECT_EQ(ends.counts[0][0], 1u);
    EXPECT_EQ(ends.counts[1][3], 2u) << "the upper end is not above the axis";
    EXPECT_EQ(ends.above[2], 1);
    EXPECT_EQ(ends.below[0], 1);
    EXPECT_EQ(ends.counts[2][2], 1u) << "a border belongs to the upper bin";
}

TEST(Waveform, IsAHistogramOfEachColumn) {
    constexpr int width = 30, height = 20;
    std::vector<float> rgb = random_image(width * height);
    for (float& x : rgb) x = std::min(std::abs(x), 1.f); // all within the axis
    const Waveform w = waveform(rgb, width, unit, 10, 16);
    const Histogram all = histogram(rgb, unit, 16);
    for (size_t k = 0; k < scope_channels; ++k)
        for (int level = 0; level < 16; ++level) {
            uint32_t sum = 0;
            for (int column = 0; column < 10; ++column) sum += w.counts[k][size_t(level * 10 + column)];
            EXPECT_EQ(sum, all.counts[k][size_t(level)]);
        }
    for (int column = 0; column < 10; ++column) {
        uint32_t sum = 0;
        for (int level = 0; level < 16; ++level) sum += w.counts[0][size_t(level * 10 + column)];
        EXPECT_EQ(sum, 3u * height);
    }
}

TEST(Waveform, LaysAGradientOutAsALine) {
    std::vector<float> rgb;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 8; ++x) rgb.insert(rgb.end(), 3, (float(x) + 0.5f) / 8);
    const Waveform w = waveform(rgb, 8, unit, 64, 8);
    EXPECT_EQ(w.columns, 8) << "no more columns than pixels";
    for (int x = 0; x < 8; ++x)
        for (int level = 0; level < 8; ++level) EXPECT_EQ(w.counts[1][size_t(level * 8 + x)], x == level ? 3u : 0u);
}

TEST(Waveform, CountsValuesBeyondInTheEndLevels) {
    const Waveform w = waveform(std::vector<float>{-5, 7, nan}, 1, unit, 1, 4);
    EXPECT_EQ(w.counts[0][0], 1u);
    EXPECT_EQ(w.counts[1][3], 1u);
    EXPECT_EQ(w.counts[2][0], 1u);
}

TEST(ValueStatistics, IsMeanRangeAndDeviation) {
    const ValueStatistics s = value_statistics(std::vector<float>{2, 4, 4, 4, 5, 5, 7, 9, nan, inf});
    EXPECT_EQ(s.count, 8);
    EXPECT_DOUBLE_EQ(s.mean, 5);
    EXPECT_DOUBLE_EQ(s.deviation, 2);
    EXPECT_EQ(s.low, 2);
    EXPECT_EQ(s.high, 9);
    EXPECT_EQ(value_statistics({}).count, 0);
}

// The deviation is accurate for a large mean.
TEST(ValueStatistics, IsAccurateForSmallDifferencesOfLargeValues) {
    const ValueStatistics s = value_statistics(std::vector<float>{1e6f + 1, 1e6f - 1, 1e6f + 1, 1e6f - 1});
    EXPECT_DOUBLE_EQ(s.deviation, 1);
}

} // namespace
} // namespace blush::TEST_FILE
