// Running means and histograms of contributions against values that are known.
#include "measure/statistics/path_statistics.h"

#include "measure/statistics/intervals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace blush::TEST_FILE {
namespace {

std::vector<double> random_values(int count, uint32_t seed) {
    std::mt19937 random(seed);
    std::exponential_distribution<double> value(0.5); // mean 2
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(value(random));
    return values;
}

TEST(PathStatistics, RunningMeansAreThoseOfThePrefixes) {
    const std::vector<double> values = random_values(1000, 3);
    const std::vector<RunningMean> means = running_means(values);
    EXPECT_EQ(means.front().samples, 1);
    EXPECT_EQ(means.front().low, means.front().high);
    EXPECT_EQ(means.back().samples, 1000);
    EXPECT_LT(means.size(), 90u);
    int64_t before = 0;
    for (const RunningMean& m : means) {
        EXPECT_GT(m.samples, before);
        before = m.samples;
        if (m.samples == 1) continue;
        const Interval expected = mean_interval({values.data(), size_t(m.samples)});
        EXPECT_NEAR(m.mean, expected.value, 1e-12);
        EXPECT_NEAR(m.low, expected.low, 1e-9);
        EXPECT_NEAR(m.high, expected.high, 1e-9);
    }
}

TEST(PathStatistics, IntervalsCoverTheTruth) {
    int covered = 0;
    constexpr int runs = 1000;
    for (int i = 0; i < runs; ++i) {
        const RunningMean m = running_means(random_values(200, uint32_t(i))).back();
        covered += m.low <= 2 && 2 <= m.high;
    }
    EXPECT_GT(covered, 0.92 * runs);
    EXPECT_LT(covered, 0.97 * runs);
}

TEST(PathStatistics, HistogramsCountAllValues) {
    const std::vector<double> values{0, 0, 1, 1.1, 4, 4, 4.5, 1024, -1};
    const LogHistogram h = log_histogram(values, 24);
    EXPECT_EQ(h.zeros, 3);
    EXPECT_EQ(std::accumulate(h.counts.begin(), h.counts.end(), int64_t(0)), 6);
    EXPECT_DOUBLE_EQ(h.low, 1);
    EXPECT_DOUBLE_EQ(h.high, 1024 * std::sqrt(2));
    EXPECT_DOUBLE_EQ(h.edge(4), 4);
    EXPECT_EQ(h.counts[0], 2);
    EXPECT_EQ(h.counts[4], 3);
    EXPECT_EQ(h.counts.back(), 1);
    EXPECT_NEAR(h.shares.back(), 1024 / 1038.6, 1e-12);
    EXPECT_NEAR(std::accumulate(h.shares.begin(), h.shares.end(), 0.0), 1, 1e-12);
}

TEST(PathStatistics, SmallValuesShareTheFirstBin) {
    const LogHistogram h = log_histogram(std::vector<double>{1e-9, 1, 2, 1000}, 4);
    ASSERT_EQ(h.counts.size(), 4u);
    EXPECT_EQ(h.counts[0], 3);
    EXPECT_EQ(h.counts[3], 1);
    EXPECT_TRUE(log_histogram(std::vector<double>{0, 0}, 4).counts.empty());
    EXPECT_TRUE(running_means({}).empty());
}

} // namespace
} // namespace blush::TEST_FILE
