// Chart layout and SVG: any numbers and names give a drawable result.
#include "measure/plot/plot_layout.h"
#include "measure/plot/plot_svg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace blush::test::TEST_FILE {
namespace {

size_t count_of(const std::string& text, const std::string& part) {
    size_t count = 0;
    for (size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(Plot, DrawsEachPointOfEachCurve) {
    Plot plot{"error",       "seconds",
              "RMSE",        {{"a", plot_color(0), {{1, 1}, {10, 0.3}, {100, 0.1}}}, {"b", plot_color(1), {{1, 2}, {10, 0.5}}}},
              {{5, "edit"}}, {}};
    const std::string svg = to_svg(plot);
    EXPECT_EQ(count_of(svg, "<polyline"), 2u);
    EXPECT_EQ(count_of(svg, "<circle"), 5u);
    EXPECT_EQ(count_of(svg, ">edit<"), 1u);
    for (const char* number : {">1<", ">10<", ">100<", ">0.1<", ">seconds<", ">RMSE<"}) EXPECT_GE(count_of(svg, number), 1u) << number;
}

TEST(Plot, SkipsValuesWithoutALogarithm) {
    const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
    Plot plot{"", "", "", {{"a", "#000", {{0, 1}, {1, 0}, {-1, 1}, {nan, 1}, {1, nan}, {1, inf}, {2, 2}}}}, {{0, "never"}}, {}};
    const std::string svg = to_svg(plot);
    EXPECT_EQ(count_of(svg, "<circle"), 1u);
    EXPECT_EQ(count_of(svg, "nan"), 0u);
    EXPECT_EQ(count_of(svg, "inf"), 0u);
    EXPECT_EQ(count_of(svg, "never"), 0u);
    EXPECT_EQ(count_of(to_svg({}), "nan"), 0u);
}

TEST(Plot, NamesAreEscaped) {
    EXPECT_EQ(escaped_markup("<b>\"x\" & 'y'\x01"), "&lt;b&gt;&quot;x&quot; &amp; &#39;y&#39; ");
    Plot plot{"<script>", "", "", {{"<i>", "#000", {{1, 1}}}}, {}, {}};
    EXPECT_EQ(count_of(to_svg(plot), "<script>") + count_of(to_svg(plot), "<i>"), 0u);
}

TEST(Plot, GuideFallsWithItsSlopeThroughTheFirstPoint) {
    Plot plot{"", "", "", {{"a", "#000", {{4, 8}, {400, 1}}}}, {}, {}};
    const PlotCurve guide = plot_guide(plot, -0.5, "guide");
    ASSERT_EQ(guide.points.size(), 2u);
    EXPECT_NEAR(guide.points[0].y, 8, 1e-9);
    EXPECT_NEAR(guide.points[1].y, 0.8, 1e-9);
    EXPECT_TRUE(plot_guide({}, -0.5, "").points.empty());
    plot.curves.push_back({"b", "#000", {{1, 1}, {40, 1}}});
    const PlotCurve along = plot_guide(plot, -0.5, "guide", &plot.curves[0]);
    EXPECT_NEAR(along.points[0].x, 1, 1e-12) << "over all there is";
    EXPECT_NEAR(along.points[0].y, 16, 1e-9) << "through the first point of one";
}

Plot two_curves() {
    return {"", "x", "y", {{"a", "#000", {{1, 1}, {10, 0.3, 0.2, 0.4}, {100, 0.1, 0.05, 0.2}}}, {"b", "#000", {{1, 2}, {10, 0.5}}}},
            {}, {}};
}

TEST(PlotLayout, MapsPowersOfTenEvenlyAndBack) {
    const PlotLayout l = compute_plot_layout(two_curves(), {});
    EXPECT_NEAR(l.px(10) - l.px(1), l.px(100) - l.px(10), 1e-9);
    EXPECT_NEAR(l.py(1) - l.py(10), l.py(0.1) - l.py(1), 1e-9);
    EXPECT_LT(l.py(10), l.py(1)) << "larger values are higher";
    for (const double x : {1.0, 7.0, 99.0}) EXPECT_NEAR(l.x_axis.value(l.x_axis.fraction(x)) / x, 1, 1e-12);
    for (const PlotLayout::Curve& c : l.curves)
        for (const PlotPixel& p : c.line) {
            EXPECT_TRUE(p.x > l.left && p.x < l.right) << p.x;
            EXPECT_TRUE(p.y > l.top && p.y < l.bottom) << p.y;
        }
    ASSERT_EQ(l.curves[0].band.size(), 4u) << "there and back over the two points with an interval";
    EXPECT_LT(l.curves[0].band[0].y, l.curves[0].band[3].y);
}

TEST(PlotLayout, AxesEndAtRoundNumbersAndAreStable) {
    const auto axis = [](double last) {
        return compute_plot_layout({"", "", "", {{"", "#000", {{1, 1}, {last, 0.5}}}}, {}, {}}, {}).x_axis;
    };
    for (double last = 1.1; last < 1e6; last *= 1.37) {
        const LogAxis x = axis(last);
        for (const double end : {x.low, x.high}) {
            const double digit = std::pow(10, end - std::floor(end + 1e-9));
            EXPECT_TRUE(std::abs(digit - 1) < 1e-6 || std::abs(digit - 2) < 1e-6 || std::abs(digit - 5) < 1e-6) << digit;
        }
        EXPECT_LT(x.low, 0);
        EXPECT_GT(x.high, std::log10(last));
    }
    EXPECT_EQ(axis(22).high, axis(40).high);
}

// Any range has at least one label, and labels do not overlap.
TEST(PlotLayout, LabelsDoNotOverlapAndAlwaysExist) {
    for (const double span : {1.0001, 1.5, 3.0, 20.0, 1e3, 1e7, 1e15}) {
        for (const double width : {200.0, 640.0}) {
            for (double from = 1e-9; from < 1e5; from *= 7.3) {
                const Plot plot{"", "", "", {{"", "#000", {{from, from}, {from * span, from * span}}}}, {}, {}};
                const PlotLayout l = compute_plot_layout(plot, {width, 300, 12, true, {}});
                const PlotTick* before = nullptr;
                for (const PlotTick& t : l.x_ticks) {
                    EXPECT_NEAR(t.at, l.px(t.value), 1e-9);
                    if (t.text.empty()) continue;
                    EXPECT_NEAR(std::stod(t.text) / t.value, 1, 1e-9);
                    const double room = before ? t.at - before->at : width;
                    EXPECT_GT(room, 0.55 * 12 * double(t.text.size() + (before ? before->text.size() : 0)) / 2) << t.text;
                    before = &t;
                }
                EXPECT_TRUE(before) << from << " " << span;
                EXPECT_TRUE(std::ranges::any_of(l.y_ticks, [](const PlotTick& t) { return !t.text.empty(); }));
            }
        }
    }
}

TEST(PlotLayout, LabelsOfMarksDoNotOverlap) {
    Plot plot = two_curves();
    for (const double x : {2.0, 2.1, 2.2, 2.3, 50.0, 99.0, 1e9, -1.0}) plot.marks.push_back({x, "Change light sun"});
    const PlotLayout l = compute_plot_layout(plot, {});
    EXPECT_EQ(l.marks.size(), 6u) << "those within the axes";
    size_t labelled = 0;
    for (size_t i = 0; i < l.marks.size(); ++i) {
        if (l.marks[i].label.empty()) continue;
        ++labelled;
        const double width = 0.55 * 12 * double(l.marks[i].label.size());
        EXPECT_GE(l.marks[i].text.x, l.left);
        EXPECT_LE(l.marks[i].text.x + width, l.right);
        for (size_t k = 0; k < i; ++k) {
            if (l.marks[k].label.empty() || l.marks[k].text.y != l.marks[i].text.y) continue;
            EXPECT_GE(std::abs(l.marks[k].text.x - l.marks[i].text.x), width);
        }
    }
    EXPECT_EQ(labelled, 5u) << "the fourth label at the same x has no room";
}

TEST(PlotLayout, TheLegendAvoidsTheCurves) {
    Plot plot{"", "", "", {{"falls", "#000", {}}}, {}, {}};
    for (double x = 1; x < 1e4; x *= 1.3) plot.curves[0].points.push_back({x, 1 / x});
    const PlotLayout falling = compute_plot_layout(plot, {});
    EXPECT_GT(falling.legend[0].text.y, (falling.top + falling.bottom) / 2) << "below a curve that falls";
    for (PlotCurve::Point& p : plot.curves[0].points) p.y = p.x < 100 ? 1e-6 : 1e-6 * p.x;
    const PlotLayout low = compute_plot_layout(plot, {});
    EXPECT_GT(low.legend[0].text.x, (low.left + low.right) / 2) << "beside one that begins low";
    EXPECT_TRUE(compute_plot_layout(plot, {640, 420, 12, false, {}}).legend.empty());
}

TEST(PlotLayout, PicksTheNearestPoint) {
    Plot plot = two_curves();
    plot.curves.push_back(plot_guide(plot, -0.5, "guide"));
    plot.curves[0].points.insert(plot.curves[0].points.begin(), {-1, 1});
    const PlotLayout l = compute_plot_layout(plot, {});
    const auto at = pick(plot, l, l.px(10) + 3, l.py(0.3) - 2, 10);
    ASSERT_TRUE(at);
    EXPECT_EQ(at->curve, 0u);
    EXPECT_EQ(at->point, 2u) << "counted with skipped points";
    EXPECT_NEAR(at->at.x, l.px(10), 1e-9);
    EXPECT_FALSE(pick(plot, l, l.px(30), l.py(2), 10));
    EXPECT_EQ(pick(plot, l, l.px(1), l.py(2), 10)->curve, 1u) << "the guide passes here too";
}

} // namespace
} // namespace blush::test::TEST_FILE
