// Chart and text of the Samplers panel.
#include "ui/views/lab/sampler_view.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

TEST(SamplerView, ShowsWhatIsKnown) {
    SamplerReport report;
    EXPECT_TRUE(sampler_gain_text(report).empty());
    EXPECT_TRUE(sampler_plot(report).curves[0].points.empty());
    report.sides[0][1] = {true, 0.5, 0.4, 0.6};
    report.sides[0][2] = {true, 0.25, 0.2, 0.3};
    report.sides[1][2] = {true, 0.125, 0.1, 0.15};
    report.gains[2] = {true, 4, 3, 5};
    const Plot plot = sampler_plot(report);
    ASSERT_EQ(plot.curves.size(), 3u);
    EXPECT_EQ(plot.curves[0].points.size(), 2u);
    EXPECT_EQ(plot.curves[1].points.size(), 1u);
    EXPECT_EQ(plot.curves[0].points[1].x, 16);
    EXPECT_EQ(plot.curves[2].name, "1/sqrt(N)");
    EXPECT_NE(sampler_gain_text(report).find("At 16 samples per pixel: random numbers have 4 times"), std::string::npos);
}

} // namespace
} // namespace blush::TEST_FILE
