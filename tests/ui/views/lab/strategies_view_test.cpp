// What the Strategies panel shows of a report: curves without unknown errors, the scale of variances, maps and notes.
#include "ui/views/lab/strategies_view.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <cmath>

namespace blush::TEST_FILE {
namespace {

using Show = StrategiesView::Show;
using Kind = ConvergencePoint::Kind;

constexpr int width = 4, height = 2, pixels = width * height;

// MIS takes a quarter of each pixel by BSDF sampling.
StrategyReport report() {
    StrategyReport r;
    r.rounds = 2;
    r.width = width;
    r.height = height;
    float variance = 100;
    for (StrategySide& side : r.sides) {
        side.image.assign(pixels, {1, 1, 1});
        side.variance.assign(pixels, variance);
        variance /= 10;
    }
    for (size_t k = 0; k < 2; ++k) {
        r.parts[k].weight.assign(pixels, k == 0 ? 0.25f : 0.75f);
        r.parts[k].variance.assign(pixels, 0.01f);
        r.parts[k].share = k == 0 ? 0.25 : 0.75;
    }
    return r;
}

TEST(StrategiesView, CurvesHaveKnownErrorsOnly) {
    StrategyReport r = report();
    const Interval known{true, 0.1, 0.05, 0.2}, unknown{false, 0, 0, 0.2};
    r.sides[0].record.add({Kind::measured, 1, 10, known, known});
    r.sides[0].record.add({Kind::measured, 2, 20, unknown, known});
    r.sides[2].record.add({Kind::estimated, 1, 10, known, known});
    const Plot rmse = strategy_plot(r, ErrorMetric::rmse), relmse = strategy_plot(r, ErrorMetric::relmse);
    ASSERT_EQ(rmse.curves.size(), 4u);
    EXPECT_EQ(rmse.curves[0].points.size(), 1u);
    EXPECT_EQ(relmse.curves[0].points.size(), 2u);
    EXPECT_TRUE(rmse.curves[1].points.empty());
    EXPECT_EQ(rmse.curves[2].points.size(), 1u);
    EXPECT_FALSE(r.sides[0].error(ErrorMetric::rmse).known) << "the latest is not known";
    EXPECT_FALSE(r.sides[1].error(ErrorMetric::rmse).known);
    // The guide goes through the first point of MIS.
    const auto& guide = relmse.curves[3].points;
    ASSERT_EQ(guide.size(), 2u);
    EXPECT_NEAR(std::log(guide[1].y / guide[0].y) / std::log(guide[1].x / guide[0].x), -1, 1e-9);
    EXPECT_TRUE(strategy_plot(StrategyReport(), ErrorMetric::rmse).curves[3].points.empty());
}

TEST(StrategiesView, MapsShareOneScale) {
    const StrategyReport r = report();
    const VarianceScale scale = variance_scale(r, Show::variance);
    EXPECT_FLOAT_EQ(float(scale.high), 100);
    EXPECT_FLOAT_EQ(float(scale.low), 1e-4f);
    const std::vector<uint32_t> texels = strategy_texels(r, Show::variance);
    ASSERT_EQ(texels.size(), size_t(3 * pixels));
    EXPECT_EQ(texels[0], uint32_t(IM_COL32_WHITE));
    EXPECT_NE(texels[pixels], texels[2 * pixels]);
    EXPECT_FLOAT_EQ(float(variance_scale(r, Show::mis_variance).high), 1) << "that of the image of MIS is the highest";
    EXPECT_EQ(variance_scale(r, Show::image).high, 0);
}

TEST(StrategiesView, WeightsAreGreyAndMixTheColours) {
    const std::vector<uint32_t> texels = strategy_texels(report(), Show::mis_weight);
    ASSERT_EQ(texels.size(), size_t(3 * pixels));
    EXPECT_EQ(texels[0], uint32_t(IM_COL32(64, 64, 64, 255)));
    EXPECT_EQ(texels[pixels], uint32_t(IM_COL32(191, 191, 191, 255)));
    // A quarter of #62aee8 and three quarters of #f08a4b.
    EXPECT_EQ(texels[2 * pixels], uint32_t(IM_COL32((0x62 + 3 * 0xf0) / 4, (0xae + 3 * 0x8a) / 4, (0xe8 + 3 * 0x4b) / 4, 255)));
}

TEST(StrategiesView, SaysWhatIsNotKnown) {
    StrategyReport r;
    EXPECT_TRUE(strategy_texels(r, Show::variance).empty());
    EXPECT_EQ(strategy_caption(r, Show::variance), "No variance is known yet.");
    EXPECT_EQ(strategy_caption(r, Show::image), "MIS finds no light.");
    EXPECT_TRUE(strategy_notes(r).empty());
    r.zero_size_lights = 2;
    r.sides[1].dropped = 3;
    const std::vector<std::string> notes = strategy_notes(r);
    ASSERT_EQ(notes.size(), 2u);
    EXPECT_EQ(notes[0], "BSDF sampling cannot find lights without size: 2 of them. NEE samples them in all three images.");
    EXPECT_TRUE(notes[1].starts_with("Light sampling (NEE): 3 samples"));
    EXPECT_EQ(strategy_caption(report(), Show::image), "MIS finds 25.0 % of the light by BSDF sampling, 75.0 % by light sampling.");
}

} // namespace
} // namespace blush::TEST_FILE
