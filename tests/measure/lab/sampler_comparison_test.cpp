// Comparison of samplers: the points are those of the film, nets are stratified, and the measured errors are those of closed forms.
#include "measure/lab/sampler_comparison.h"

#include "render/integrator/estimator.h"
#include "tests/render/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace blush::TEST_FILE {
namespace {

TEST(SamplePoints, OfAHalfAreANetForSobolOnly) {
    // 16 points of a half: one in each of 16 columns, 16 rows and 4 x 4 squares.
    const auto strata = [](SamplerType type, uint32_t dimension, int columns, int rows) {
        std::set<std::pair<int, int>> found;
        for (const SamplePoint& p : sample_points(type, 5, 3, 7, dimension, 32))
            if (p.half == 0) found.insert({int(p.x * float(columns)), int(p.y * float(rows))});
        return found.size();
    };
    for (uint32_t dimension = 0; dimension < 14; ++dimension)
        for (const auto& [columns, rows] : {std::pair{16, 1}, {8, 2}, {4, 4}, {2, 8}, {1, 16}})
            EXPECT_EQ(strata(SamplerType::sobol, dimension, columns, rows), 16u) << dimension << ": " << columns << " x " << rows;
    size_t random = 0;
    for (uint32_t dimension = 0; dimension < 14; ++dimension) random += strata(SamplerType::random, dimension, 4, 4);
    // 16 points in 16 cells leave 16 (1 - 1/16)^16 = 5.7 of them empty on average; 14 tries, standard deviation 1.2 each.
    EXPECT_NEAR(double(random) / 14, 10.3, 4 * 1.2 / std::sqrt(14.0));
}

TEST(SamplePoints, DimensionsAreThoseOfThePathTracer) {
    EXPECT_EQ(sampler_dimension_name(0), "pixel filter");
    EXPECT_EQ(sampler_dimension_name(first_scatter_dimension + light_dimension), "light, bounce 0");
    EXPECT_EQ(sampler_dimension_name(first_scatter_dimension + dimensions_per_scatter + bsdf_dimension), "BSDF direction, bounce 1");
}

// Random numbers: the MSE falls with 1/N. Sobol points are never worse on a smooth integrand. Both have the same mean, so that the MSE
// says all.
TEST(SamplerComparison, RandomNumbersFollowTheLawOfLargeNumbers) {
    SamplerComparison lab({.threads = 2, .planes = {}});
    lab.begin(test::shipped_scene("cornell"), {.width = 24, .height = 24});
    for (int i = 0; i < 12; ++i) {
        ASSERT_TRUE(lab.round());
        EXPECT_EQ(lab.report().gains[0].known, i >= 4) << "fewer than five pairs say hardly anything of their scatter";
    }
    const SamplerReport& r = lab.report();
    EXPECT_EQ(r.pairs, 12);
    const SamplerErrors &random = r.sides[0], &sobol = r.sides[1];
    for (size_t k = 1; k < compared_sample_counts.size(); ++k) {
        ASSERT_TRUE(random[k].known && sobol[k].known);
        // Root N times the RMSE is constant: 95 % intervals of both must overlap when widened to 4 standard errors.
        const auto scaled = [&](size_t i) { return random[i].value * std::sqrt(compared_sample_counts[i]); };
        const auto wide = [&](size_t i) { return 2 * (random[i].high - random[i].low) * std::sqrt(compared_sample_counts[i]); };
        EXPECT_NEAR(scaled(k), scaled(0), wide(k) + wide(0)) << compared_sample_counts[k] << " samples";
    }
    EXPECT_GT(r.gains.back().low, 1) << "Sobol points pay in the Cornell box";
    EXPECT_NEAR(r.gains.back().value, std::pow(random.back().value / sobol.back().value, 2), 1e-9 * r.gains.back().value);
}

TEST(SamplerComparison, StopsWhenItIsNotWanted) {
    SamplerComparison lab({.threads = 1, .planes = {}});
    lab.begin(test::shipped_scene("cornell"), {.width = 16, .height = 16});
    EXPECT_FALSE(lab.round([] { return false; }));
    EXPECT_EQ(lab.report().pairs, 0);
    EXPECT_FALSE(lab.report().gains[0].known);
}

} // namespace
} // namespace blush::TEST_FILE
