// Statistical tests: p-values against tabulated quantiles, and detection of wrong densities.
#include "tests/support/statistics.h"

#include <random>

namespace blush::TEST_FILE {

using namespace statistics;

TEST(Statistics, PValuesMatchTabulatedQuantiles) {
    EXPECT_NEAR(normal_p(1.959963985), 0.05, 1e-9);
    // Upper 5 % and 0.1 % points of chi-squared: Abramowitz and Stegun, table 26.8.
    EXPECT_NEAR(gamma_q(1 / 2.0, 3.84146 / 2), 0.05, 1e-6);
    EXPECT_NEAR(gamma_q(10 / 2.0, 18.3070 / 2), 0.05, 1e-6);
    EXPECT_NEAR(gamma_q(100 / 2.0, 124.342 / 2), 0.05, 1e-5);
    EXPECT_NEAR(gamma_q(30 / 2.0, 59.703 / 2), 0.001, 1e-6);
}

TEST(Statistics, SidakKeepsTheOverallSignificance) { EXPECT_NEAR(std::pow(1 - sidak(0.01, 1000), 1000), 0.99, 1e-12); }

TEST(Statistics, MomentsMatchTheirDefinition) {
    Moments m;
    for (const double x : {1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16}) m.add(x);
    EXPECT_DOUBLE_EQ(m.mean, 1e9 + 10);
    EXPECT_DOUBLE_EQ(m.variance(), 30);
}

TEST(Statistics, MeansOfFairDicePassAndOfLoadedOnesDoNot) {
    std::mt19937 random(1);
    const Moments fair = estimate(100'000, [&] { return random() % 6 + 1; });
    const Moments other = estimate(100'000, [&] { return random() % 6 + 1; });
    const Moments loaded = estimate(100'000, [&] { return random() % 60 == 0 ? 6 : random() % 6 + 1; });
    EXPECT_TRUE(z_test(fair, 3.5));
    EXPECT_TRUE(same_mean(fair, other));
    EXPECT_TRUE(z_test_at_most(fair, 3.6));
    EXPECT_FALSE(z_test(loaded, 3.5));
    EXPECT_FALSE(same_mean(fair, loaded));
    EXPECT_FALSE(z_test_at_most(loaded, 3.5));
}

TEST(Statistics, MeansWithoutVarianceAreHeldToRounding) {
    EXPECT_TRUE(z_test(estimate(10, [] { return 1 + 1e-6; }), 1));
    EXPECT_FALSE(z_test(estimate(10, [] { return 1 + 1e-5; }), 1));
    EXPECT_FALSE(z_test(estimate(10, [] { return NAN; }), 1));
}

TEST(Statistics, ChiSquaredSeesAWrongDensityAndAWrongIntegral) {
    std::mt19937 random(2);
    std::normal_distribution<float> normal;
    const auto uniform = [&]() -> std::optional<Vec3> {
        const Vec3 v{normal(random), normal(random), normal(random)};
        const float r = std::hypot(v.x, v.y, v.z);
        return Vec3{v.x / r, v.y / r, v.z / r};
    };
    const double density = 1 / (4 * std::numbers::pi);
    EXPECT_TRUE(directions_follow({}, uniform, [&](const Vec3&) { return density; }));
    EXPECT_FALSE(directions_follow({}, uniform, [&](const Vec3& w) { return density * (1 + 0.1 * w.x); }));
    EXPECT_FALSE(directions_follow({}, uniform, [&](const Vec3&) { return density * 0.99; }));
    EXPECT_FALSE(directions_follow({}, uniform, [&](const Vec3&) { return density * 1.01; }));
}

} // namespace blush::TEST_FILE
