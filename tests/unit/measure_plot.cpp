// Charts as SVG: whatever numbers and names come in, what comes out can be drawn.
#include "measure/plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace blush::test {
namespace {

size_t count_of(const std::string& text, const std::string& part) {
    size_t count = 0;
    for (size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(Plot, DrawsEachPointOfEachCurve) {
    Plot plot{"error",
              "seconds",
              "RMSE",
              {{"a", plot_color(0), {{1, 1}, {10, 0.3}, {100, 0.1}}}, {"b", plot_color(1), {{1, 2}, {10, 0.5}}}},
              {{5, "edit"}}};
    const std::string svg = to_svg(plot);
    EXPECT_EQ(count_of(svg, "<polyline"), 2u);
    EXPECT_EQ(count_of(svg, "<circle"), 5u);
    EXPECT_EQ(count_of(svg, ">edit<"), 1u);
    for (const char* number : {">1<", ">10<", ">100<", ">0.1<", ">seconds<", ">RMSE<"}) EXPECT_GE(count_of(svg, number), 1u) << number;
}

TEST(Plot, LeavesOutWhatALogarithmCannotShow) {
    const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
    Plot plot{"", "", "", {{"a", "#000", {{0, 1}, {1, 0}, {-1, 1}, {nan, 1}, {1, nan}, {1, inf}, {2, 2}}}}, {{0, "never"}}};
    const std::string svg = to_svg(plot);
    EXPECT_EQ(count_of(svg, "<circle"), 1u);
    EXPECT_EQ(count_of(svg, "nan"), 0u);
    EXPECT_EQ(count_of(svg, "inf"), 0u);
    EXPECT_EQ(count_of(svg, "never"), 0u);
    EXPECT_EQ(count_of(to_svg({}), "nan"), 0u);
}

TEST(Plot, NamesCannotBreakOutOfTheMarkup) {
    EXPECT_EQ(escaped_markup("<b>\"x\" & 'y'\x01"), "&lt;b&gt;&quot;x&quot; &amp; &#39;y&#39; ");
    Plot plot{"<script>", "", "", {{"<i>", "#000", {{1, 1}}}}, {}};
    EXPECT_EQ(count_of(to_svg(plot), "<script>") + count_of(to_svg(plot), "<i>"), 0u);
}

TEST(Plot, GuideFallsWithItsSlopeThroughTheFirstPoint) {
    Plot plot{"", "", "", {{"a", "#000", {{4, 8}, {400, 1}}}}, {}};
    const PlotCurve guide = plot_guide(plot, -0.5, "guide");
    ASSERT_EQ(guide.points.size(), 2u);
    EXPECT_NEAR(guide.points[0].y, 8, 1e-9);
    EXPECT_NEAR(guide.points[1].y, 0.8, 1e-9);
    EXPECT_TRUE(plot_guide({}, -0.5, "").points.empty());
}

} // namespace
} // namespace blush::test
