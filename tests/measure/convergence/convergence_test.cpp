// Fits, intervals, convergence records and scheduling of variants, on data with known results.
#include "measure/convergence/convergence.h"
#include "tests/support/statistics.h"

#include <random>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

TEST(Intervals, StudentsQuantilesAreThoseOfTables) {
    // Two-sided 95 %: Abramowitz and Stegun, table 26.10.
    const std::pair<int, double> table[]{{1, 12.706}, {2, 4.303},  {3, 3.182},  {4, 2.776},
                                         {5, 2.571},  {10, 2.228}, {30, 2.042}, {120, 1.980}};
    for (const auto& [degrees, value] : table) EXPECT_NEAR(student_95(degrees) / value, 1, 0.005) << degrees;
}

TEST(Intervals, NormalQuantileUndoesTheProbability) {
    for (const double p : {0.5, 0.05, 1e-3, 1e-6}) EXPECT_NEAR(normal_two_sided(normal_quantile_two_sided(p)) / p, 1, 1e-9);
}

TEST(Intervals, CoverageOfTheMeanIs95Percent) {
    std::mt19937 bits(1);
    std::normal_distribution<double> normal(3, 2);
    Moments inside;
    for (int run = 0; run < 4000; ++run) {
        double values[4];
        for (double& v : values) v = normal(bits);
        const Interval i = mean_interval(values);
        inside.add(i.low <= 3 && 3 <= i.high);
    }
    EXPECT_TRUE(z_test(inside, 0.95));
}

TEST(Intervals, OneValueHasNoInterval) {
    const double one[]{7};
    EXPECT_FALSE(mean_interval(one).known);
    EXPECT_EQ(mean_interval(one).value, 7);
    EXPECT_FALSE(mean_interval({}).known);
}

TEST(PowerFit, FindsAKnownSlopeWithinItsInterval) {
    std::mt19937 bits(2);
    std::normal_distribution<double> noise(0, 0.1);
    Moments slopes, inside;
    for (int run = 0; run < 2000; ++run) {
        std::vector<double> x, y;
        for (int i = 0; i < 8; ++i) {
            x.push_back(std::pow(2, i));
            y.push_back(0.3 * std::pow(x.back(), -0.5) * std::exp(noise(bits)));
        }
        const PowerFit fit = fit_power(x, y);
        slopes.add(fit.slope.value);
        inside.add(fit.slope.low <= -0.5 && -0.5 <= fit.slope.high);
    }
    EXPECT_TRUE(z_test(slopes, -0.5, sidak(significance, 2)));
    EXPECT_TRUE(z_test(inside, 0.95, sidak(significance, 2)));
}

TEST(PowerFit, PredictsWhereACurveReachesAValue) {
    const double x[]{1, 4, 16}, y[]{1, 0.5, 0.25};
    const PowerFit fit = fit_power(x, y);
    EXPECT_NEAR(fit.slope.value, -0.5, 1e-12);
    EXPECT_NEAR(reach(fit, 0.1), 100, 1e-9);
    EXPECT_EQ(reach(fit_power(y, x), 0.1) > 0, true);
    const double flat[]{1, 1, 1};
    EXPECT_EQ(reach(fit_power(x, flat), 0.1), 0);
    EXPECT_FALSE(fit_power(flat, y).slope.known);
}

// Errors of running means: the correlation of the points must not make the interval of the slope too narrow.
TEST(PowerFit, CoverageOfRunningMeansIs95Percent) {
    std::mt19937 bits(3);
    std::normal_distribution<double> normal;
    constexpr int pixels = 60, longest = 400;
    Moments slopes, inside;
    for (int run = 0; run < 600; ++run) {
        std::vector<double> sums(pixels), x, y, samples;
        double due = 4;
        for (int n = 1; n <= longest; ++n) {
            for (double& s : sums) s += normal(bits);
            if (n < due) continue;
            due = std::max(1.1 * n, n + 1.0);
            double squares = 0;
            for (const double s : sums) squares += s * s / (n * n);
            x.push_back(0.01 * n);
            y.push_back(std::sqrt(squares / pixels));
            samples.push_back(n);
        }
        const PowerFit fit = fit_running(x, y, samples);
        slopes.add(fit.slope.value);
        inside.add(fit.slope.low <= -0.5 && -0.5 <= fit.slope.high);
    }
    EXPECT_TRUE(z_test(slopes, -0.5, sidak(significance, 2)));
    EXPECT_TRUE(z_test(inside, 0.95, sidak(significance, 2)));
}

using Kind = ConvergencePoint::Kind;

ConvergencePoint at(double seconds, int64_t spp, Kind kind = Kind::estimated) {
    const double relmse = 1.0 / double(spp);
    return {
        kind, seconds, spp, {true, std::sqrt(relmse), 0.9 * std::sqrt(relmse), 1.1 * std::sqrt(relmse)}, {true, relmse, relmse, relmse}};
}

TEST(ConvergenceRecord, KeepsPointsTenPercentApartForEachKind) {
    ConvergenceRecord record;
    int kept = 0;
    for (int64_t spp = 1; spp <= 100000; ++spp) kept += record.add(at(double(spp), spp));
    EXPECT_LT(kept, 120);
    EXPECT_EQ(size_t(kept), record.points().size());
    EXPECT_TRUE(record.add(at(5, 100000, Kind::denoised)));
    EXPECT_FALSE(record.add(at(5, 100001, Kind::denoised)));
    EXPECT_EQ(record.points(Kind::denoised).size(), 1u);
    EXPECT_NEAR(fit(record, Kind::estimated, ErrorMetric::rmse, ProgressAxis::spp).slope.value, -0.5, 1e-9);
    EXPECT_NEAR(fit(record, Kind::estimated, ErrorMetric::relmse, ProgressAxis::seconds).slope.value, -1, 1e-9);
    EXPECT_FALSE(fit(record, Kind::denoised, ErrorMetric::rmse, ProgressAxis::spp).slope.known);
}

TEST(ConvergenceRecord, APointIsReplacedAtTheSameSampleCount) {
    ConvergenceRecord record;
    for (const int64_t spp : {4, 16, 8, 16}) record.set(at(spp == 16 ? double(record.points().size()) : 1.0, spp, Kind::denoised));
    ASSERT_EQ(record.points().size(), 3u);
    EXPECT_EQ(record.points()[1].spp, 8) << "in the order of samples";
    EXPECT_EQ(record.points()[2].seconds, 3) << "the later one";
}

TEST(TimeLeft, IsExtrapolatedWithAnInterval) {
    using State = TimeLeft::State;
    ConvergenceRecord record;
    const auto left = [&](double target) { return time_left(record, Kind::estimated, ErrorMetric::relmse, target); };
    EXPECT_EQ(left(0.1).state, State::too_few);
    for (const int64_t spp : {2, 4}) record.add(at(0.5 * double(spp), spp));
    EXPECT_EQ(left(0.1).state, State::too_few);
    for (const int64_t spp : {8, 16}) record.add(at(0.5 * double(spp), spp));
    EXPECT_EQ(left(0.1).state, State::reached);
    EXPECT_EQ(left(0).state, State::too_few) << "no target";
    const TimeLeft t = left(1.0 / 64);
    EXPECT_EQ(t.state, State::known);
    EXPECT_NEAR(t.seconds, 32 - 8, 1e-9);
    EXPECT_NEAR(t.low, t.seconds, 1e-6) << "slope and point have no uncertainty";
    const TimeLeft of_rmse = time_left(record, Kind::estimated, ErrorMetric::rmse, 1.0 / 8);
    EXPECT_NEAR(of_rmse.seconds, 32 - 8, 1e-9);
    EXPECT_NEAR(of_rmse.low, 32 * 0.81 - 8, 1e-6) << "the point's own interval counts";
    EXPECT_NEAR(of_rmse.high, 32 * 1.21 - 8, 1e-6);
    EXPECT_EQ(left(1e-9).state, State::too_far);
}

// Without information there is no prediction.
TEST(TimeLeft, IsUnknownWithoutATrend) {
    ConvergenceRecord flat, scattered;
    for (const int64_t spp : {2, 4, 8, 16, 32}) {
        ConvergencePoint p = at(double(spp), spp);
        p.rmse = {true, 1, 0.9, 1.1};
        flat.add(p);
        p.rmse.value = spp == 4 || spp == 32 ? 0.4 : 1;
        scattered.add(p);
    }
    EXPECT_EQ(time_left(flat, Kind::estimated, ErrorMetric::rmse, 0.1).state, TimeLeft::State::no_trend);
    EXPECT_EQ(time_left(scattered, Kind::estimated, ErrorMetric::rmse, 0.1).state, TimeLeft::State::no_trend);
}

TEST(Turns, GoToTheVariantWithTheLeastTime) {
    EXPECT_EQ(next_variant({3, 1, 2}), 1);
    EXPECT_EQ(next_variant({-1, -1, 2}), 2);
    EXPECT_EQ(next_variant({-1, -1}), -1);
    EXPECT_EQ(next_variant({}), -1);
    // A variant with ten times longer turns gets no more time than the others, within one turn.
    std::vector<double> seconds{0, 0, 0};
    const double turn[]{0.1, 1, 0.1};
    for (int i = 0; i < 500; ++i) {
        const int next = next_variant(seconds);
        seconds[size_t(next)] += turn[next];
        EXPECT_LE(*std::ranges::max_element(seconds) - *std::ranges::min_element(seconds), 1 + 1e-9);
    }
}

TEST(DoublingTimes, AreDueWheneverTimeHasDoubled) {
    DoublingTimes times;
    std::vector<int> due;
    for (int t = 1; t <= 100; ++t)
        if (times.due(t)) due.push_back(t);
    EXPECT_EQ(due, (std::vector{1, 2, 4, 8, 16, 32, 64}));
}

} // namespace
} // namespace blush::test::TEST_FILE
