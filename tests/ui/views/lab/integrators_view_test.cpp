// What the Integrators panel shows of a report: places and amounts in words, verdicts, curves, the map of the difference.
#include "ui/views/lab/integrators_view.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <cmath>

namespace blush::TEST_FILE {
namespace {

constexpr int width = 240, height = 120;

RegionBias region(int x, int y, double percent, double error = 0.1) {
    RegionBias r;
    r.x = x, r.y = y, r.width = 30, r.height = 15;
    r.reference = 1;
    r.mean = 1 + percent / 100;
    r.error = error / 100;
    r.degrees = 1e6;
    return r;
}

IntegratorReport report(const std::vector<RegionBias>& regions) {
    IntegratorReport r;
    r.rounds = 3;
    r.width = width;
    r.height = height;
    r.verdict.threshold = 4;
    r.verdict.rounding = 1e-5;
    r.verdict.regions = regions;
    r.verdict.whole = region(0, 0, -0.5);
    r.verdict.whole.width = width;
    r.verdict.whole.height = height;
    for (const RegionBias& own : regions) {
        r.verdict.biased |= r.verdict.is_biased(own);
        if (std::abs(own.z()) > std::abs(r.verdict.worst.z())) r.verdict.worst = own;
    }
    return r;
}

TEST(IntegratorsView, PlacesAreThirdsOfTheImage) {
    const IntegratorReport r = report({});
    EXPECT_EQ(place_of(region(0, 0, 1), r), "at the top left");
    EXPECT_EQ(place_of(region(105, 0, 1), r), "at the top");
    EXPECT_EQ(place_of(region(210, 105, 1), r), "at the bottom right");
    EXPECT_EQ(place_of(region(0, 52, 1), r), "at the left");
    EXPECT_EQ(place_of(region(105, 52, 1), r), "in the middle");
    EXPECT_EQ(place_of(r.verdict.whole, r), "over the whole image");
}

TEST(IntegratorsView, AmountsSayTheDirection) {
    EXPECT_EQ(amount_of(region(0, 0, -3.14)), "3.1 % too dark");
    EXPECT_EQ(amount_of(region(0, 0, 0.123)), "0.12 % too bright");
    EXPECT_EQ(amount_of(region(0, 0, 250)), "250 % too bright");
}

TEST(IntegratorsView, VerdictNamesTheWorstRegionThatIsNoNoise) {
    EXPECT_EQ(integrator_verdict(IntegratorReport()), "Too few samples for a verdict.");
    // 5 % of a region with as much noise is no bias, 0.3 % of a quiet one is.
    EXPECT_EQ(integrator_verdict(report({region(0, 0, 5, 5), region(30, 0, 0.2)})),
              "No bias found in the noise so far: whole image -0.50 ± 0.1 %.");
    EXPECT_EQ(integrator_verdict(report({region(0, 0, -5, 5), region(210, 105, -3.1), region(0, 105, 1.2)})),
              "Biased: 3.1 % too dark at the bottom right (± 0.1 %); 2 of 3 regions differ, the whole image is 0.50 % too dark (± 0.1 %).");
}

TEST(IntegratorsView, BiasIsSaidOrHidden) {
    IntegratorReport r = report({});
    EXPECT_EQ(integrator_bias_text(r, ComparisonIntegrator::Kind::ambient, ErrorMetric::rmse), "Bias as RMSE: hidden by noise so far.");
    r.bias_relmse = {true, 0.0123, 0.012, 0.0126};
    EXPECT_EQ(integrator_bias_text(r, ComparisonIntegrator::Kind::ambient, ErrorMetric::relmse),
              "Bias as relMSE: 0.0123 (0.012 to 0.0126) stays, however long it renders.");
    EXPECT_EQ(integrator_bias_text(r, ComparisonIntegrator::Kind::progressive_photon_map, ErrorMetric::relmse),
              "Bias as relMSE: 0.0123 (0.012 to 0.0126) so far, and falls with the samples.");
    EXPECT_EQ(integrator_bias_text(r, ComparisonIntegrator::Kind::metropolis, ErrorMetric::relmse),
              "Unbiased by construction: its error is noise, which falls with the samples.");
}

TEST(IntegratorsView, SamplesThatAreLeftOutAreSaid) {
    IntegratorReport r = report({});
    EXPECT_EQ(integrator_note(r), "");
    r.biased.dropped = 3;
    EXPECT_EQ(integrator_note(r), "Samples that were not finite or negative are left out: 0 of path tracing, 3 of the other.");
}

TEST(IntegratorsView, CurvesHaveKnownErrorsOnlyAndTheBiasIsALevel) {
    IntegratorReport r = report({});
    const Interval known{true, 0.1, 0.05, 0.2}, unknown{false, 0, 0, 0.2};
    using Kind = ConvergencePoint::Kind;
    r.path.noise.add({Kind::estimated, 1, 10, known, known});
    r.error.add({Kind::measured, 1, 10, unknown, known});
    r.biased.noise.add({Kind::estimated, 1, 10, known, unknown});
    r.bias_rmse = known;
    const Plot rmse = integrator_plot(r, ComparisonIntegrator::Kind::photon_map, ErrorMetric::rmse),
               relmse = integrator_plot(r, ComparisonIntegrator::Kind::photon_map, ErrorMetric::relmse);
    ASSERT_EQ(rmse.curves.size(), 4u);
    EXPECT_EQ(rmse.curves[1].name, "Photon map");
    EXPECT_EQ(rmse.curves[0].points.size(), 1u);
    EXPECT_EQ(rmse.curves[1].points.size(), 0u);
    EXPECT_EQ(rmse.curves[2].points.size(), 1u);
    EXPECT_EQ(relmse.curves[1].points.size(), 1u);
    EXPECT_EQ(relmse.curves[2].points.size(), 0u);
    ASSERT_EQ(rmse.levels.size(), 1u);
    EXPECT_EQ(rmse.levels[0].y, 0.1);
    EXPECT_TRUE(relmse.levels.empty());
}

TEST(IntegratorsView, DifferenceIsBlueWhereDarkAndRedWhereBright) {
    IntegratorReport r = report({});
    r.path.image = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {0, 0, 0}};
    r.biased.image = {{0.5f, 0.5f, 0.5f}, {2, 2, 2}, {1, 1, 1}, {0, 0, 0}};
    const std::vector<uint32_t> t = difference_texels(r);
    ASSERT_EQ(t.size(), 4u);
    const auto red = [&](size_t i) { return int(t[i] >> IM_COL32_R_SHIFT & 255); };
    const auto blue = [&](size_t i) { return int(t[i] >> IM_COL32_B_SHIFT & 255); };
    EXPECT_GT(blue(0), red(0) + 100);
    EXPECT_GT(red(1), blue(1) + 100);
    EXPECT_EQ(red(2), blue(2));
    EXPECT_EQ(t[2], t[3]) << "black on black is no difference";
}

} // namespace
} // namespace blush::TEST_FILE
