// Fits, intervals, the recorder and the order of turns, on data whose answers are known.
#include "measure/convergence.h"
#include "statistics.h"

#include <random>

namespace blush::test {
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

TEST(Intervals, OfAMeanHoldsItInNineteenOfTwentyCases) {
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

TEST(Intervals, OfOneValueIsNotKnown) {
    const double one[]{7};
    EXPECT_FALSE(mean_interval(one).known);
    EXPECT_EQ(mean_interval(one).value, 7);
    EXPECT_FALSE(mean_interval({}).known);
}

TEST(PowerFit, FindsAKnownSlopeAndItsIntervalHoldsIt) {
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

TEST(PowerFit, SaysWhereACurveArrives) {
    const double x[]{1, 4, 16}, y[]{1, 0.5, 0.25};
    const PowerFit fit = fit_power(x, y);
    EXPECT_NEAR(fit.slope.value, -0.5, 1e-12);
    EXPECT_NEAR(reach(fit, 0.1), 100, 1e-9);
    EXPECT_EQ(reach(fit_power(y, x), 0.1) > 0, true);
    const double flat[]{1, 1, 1};
    EXPECT_EQ(reach(fit_power(x, flat), 0.1), 0);
    EXPECT_FALSE(fit_power(flat, y).slope.known);
}

ConvergencePoint at(double seconds, int64_t spp, bool denoised = false) {
    const double relmse = 1.0 / double(spp);
    return {seconds, spp, relmse, relmse, relmse, std::sqrt(relmse), denoised};
}

TEST(ConvergenceRecord, KeepsPointsATenthApartForEachKind) {
    ConvergenceRecord record;
    int kept = 0;
    for (int64_t spp = 1; spp <= 100000; ++spp) kept += record.add(at(double(spp), spp));
    EXPECT_LT(kept, 120);
    EXPECT_EQ(size_t(kept), record.points().size());
    EXPECT_TRUE(record.add(at(5, 100000, true)));
    EXPECT_FALSE(record.add(at(5, 100001, true)));
    EXPECT_NEAR(record.fit_spp().slope.value, -0.5, 1e-9);
    EXPECT_FALSE(record.fit_spp(true).slope.known);
}

TEST(ConvergenceRecord, TellsTheTimeLeft) {
    ConvergenceRecord record;
    EXPECT_LT(seconds_left(record, 0.1), 0);
    for (const int64_t spp : {2, 4, 8, 16}) record.add(at(0.5 * double(spp), spp));
    EXPECT_NEAR(seconds_left(record, 1.0 / 64), 32 - 8, 1e-9);
    EXPECT_EQ(seconds_left(record, 0.5), 0);
}

TEST(ConvergenceRecord, CsvQuotesWhatNeedsIt) {
    ConvergenceRecord record;
    record.name = "a \"fast\", small one";
    record.add(at(1, 2));
    EXPECT_EQ(to_csv({record}),
              "name,seconds,spp,relmse,low,high,rmse,denoised\n\"a \"\"fast\"\", small one\",1,2,0.5,0.5,0.5,0.707107,0\n");
}

TEST(Turns, GoToWhoHadTheLeastTime) {
    EXPECT_EQ(next_turn({3, 1, 2}), 1);
    EXPECT_EQ(next_turn({-1, -1, 2}), 2);
    EXPECT_EQ(next_turn({-1, -1}), -1);
    EXPECT_EQ(next_turn({}), -1);
    // One that takes ten times as long for a turn has no more time than the others, to within a turn.
    std::vector<double> seconds{0, 0, 0};
    const double turn[]{0.1, 1, 0.1};
    for (int i = 0; i < 500; ++i) {
        const int next = next_turn(seconds);
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
} // namespace blush::test
