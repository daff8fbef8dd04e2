#include "measure/plot/plot_layout.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace blush {
namespace {

constexpr double max_decades_with_minor = 12, max_decades_with_twos = 2.5; // maximum decades for minor lines, and for labels at 2 and 5
constexpr double min_decades = 0.5;                                        // decades: any half decade contains a 1, 2 or 5
constexpr int label_rows = 3;                                              // for marks

bool is_shown(const PlotCurve::Point& p) { return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y); }

// Logarithm of the largest 1, 2 or 5 times a power of ten that is not above.
double round_down(double logarithm) {
    const double decade = std::floor(logarithm), rest = logarithm - decade, two = std::log10(2), five = std::log10(5);
    return decade + (rest >= five ? five : rest >= two ? two : 0);
}
double round_up(double logarithm) { return -round_down(-logarithm); } // 1/2 and 1/5 are 5 and 2 of the next decade

LogAxis axis_over(double low, double high) {
    if (!(low <= high)) return {};
    const double room = std::max({0.04 * (high - low), 0.03, (min_decades - (high - low)) / 2});
    return {round_down(low - room), round_up(high + room)};
}

// `digit` times the power of ten.
std::string tick_text(int digit, int power) {
    if (power >= -3 && power < 5) return fmt::format("{:g}", digit * std::pow(10.0, power));
    return fmt::format("{}e{}", digit, power);
}

// Lines at 1, 2, ... 9 times each power of ten; labels at the powers, and at 2 and 5 for few decades. `size_of`: extent of a
// label along the axis, pixels.
template <class At, class Size> std::vector<PlotTick> ticks_of(const LogAxis& axis, At at, Size size_of) {
    const double decades = axis.high - axis.low, slack = 1e-9;
    std::vector<PlotTick> ticks;
    for (int e = int(std::floor(axis.low)); e <= int(std::ceil(axis.high)); ++e) {
        for (int m = 1; m < 10; ++m) {
            if (m > 1 && decades > max_decades_with_minor) break;
            const double value = m * std::pow(10.0, e), logarithm = std::log10(value);
            if (logarithm < axis.low - slack || logarithm > axis.high + slack) continue;
            const bool numbered = m == 1 || (decades < max_decades_with_twos && (m == 2 || m == 5));
            ticks.push_back({value, at(value), m == 1, numbered ? tick_text(m, e) : ""});
        }
    }
    // Powers of ten first, then others if there is room between them.
    std::vector<std::pair<double, double>> taken;
    for (const bool major : {true, false}) {
        for (PlotTick& t : ticks) {
            if (t.major != major || t.text.empty()) continue;
            const double half = size_of(t.text) / 2;
            const auto covers = [&](const auto& other) { return t.at + half > other.first && t.at - half < other.second; };
            if (std::ranges::any_of(taken, covers))
                t.text.clear();
            else
                taken.emplace_back(t.at - half, t.at + half);
        }
    }
    return ticks;
}

// Axis ranges over all valid points, and over marks and levels if there are points.
void set_axes(PlotLayout& l, const Plot& plot) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double x_low = infinity, x_high = -infinity, y_low = infinity, y_high = -infinity;
    for (const PlotCurve& c : plot.curves) {
        for (const PlotCurve::Point& p : c.points) {
            if (!is_shown(p)) continue;
            x_low = std::min(x_low, std::log10(p.x));
            x_high = std::max(x_high, std::log10(p.x));
            y_low = std::min(y_low, std::log10(p.y));
            y_high = std::max(y_high, std::log10(p.y));
        }
    }
    for (const PlotLevel& level : plot.levels) {
        if (!(level.y > 0) || !std::isfinite(level.y) || !(y_low <= y_high)) continue;
        y_low = std::min(y_low, std::log10(level.y));
        y_high = std::max(y_high, std::log10(level.y));
    }
    l.x_axis = axis_over(x_low, x_high);
    l.y_axis = axis_over(y_low, y_high);
}

PlotLayout::Curve lay_out_curve(const PlotLayout& l, const PlotCurve& curve, size_t index, double em) {
    PlotLayout::Curve c;
    c.index = index;
    const auto has_room = [&](const PlotPixel& at) {
        return curve.dots != PlotCurve::Dots::none &&
               (c.dots.empty() || std::hypot(at.x - c.dots.back().x, at.y - c.dots.back().y) >= 0.5 * em);
    };
    std::vector<PlotPixel> lower;
    for (size_t i = 0; i < curve.points.size(); ++i) {
        const PlotCurve::Point& p = curve.points[i];
        if (!is_shown(p)) continue;
        c.line.push_back({l.px(p.x), l.py(p.y)});
        c.points.push_back(i);
        if (has_room(c.line.back())) c.dots.push_back(c.line.back());
        if (!(p.low >= 0) || !(p.high > p.low)) continue;
        const auto within = [&](double y) { return y > 0 ? std::clamp(l.py(y), l.top, l.bottom) : l.bottom; };
        c.band.push_back({l.px(p.x), within(p.high)});
        lower.push_back({l.px(p.x), within(p.low)});
    }
    if (c.band.size() < 2) c.band.clear(), lower.clear();
    c.band.insert(c.band.end(), lower.rbegin(), lower.rend());
    return c;
}

// Labels right of their lines, in the first free row.
void lay_out_marks(PlotLayout& l, const Plot& plot, double em, const std::function<double(std::string_view)>& width) {
    std::vector<const PlotMark*> marks;
    for (const PlotMark& m : plot.marks)
        if (m.x > 0 && std::isfinite(m.x) && l.x_axis.fraction(m.x) >= 0 && l.x_axis.fraction(m.x) <= 1) marks.push_back(&m);
    std::ranges::stable_sort(marks, {}, [](const PlotMark* m) { return m->x; });
    std::vector<double> ends(label_rows, -std::numeric_limits<double>::infinity());
    for (const PlotMark* m : marks) {
        PlotLayout::Mark mark{l.px(m->x), {}, "", m->color};
        const double size = width(m->label), gap = em / 3;
        const bool on_the_left = mark.at + gap + size > l.right;
        const double from = on_the_left ? mark.at - gap - size : mark.at + gap;
        const auto row = std::ranges::find_if(ends, [&](double end) { return end <= from; });
        if (row != ends.end() && from >= l.left) {
            mark.text = {from, l.top + em * (1.1 + 1.35 * double(row - ends.begin()))};
            mark.label = m->label;
            *row = from + size + gap;
        }
        l.marks.push_back(std::move(mark));
    }
}

// Number of pixels of the curves' lines within a box, without guides.
double covered(const PlotLayout& l, const Plot& plot, double left, double top, double right, double bottom) {
    constexpr double step = 4; // pixels between two tests
    double length = 0;
    for (const PlotLayout::Curve& c : l.curves) {
        if (plot.curves[c.index].dots == PlotCurve::Dots::none) continue;
        for (size_t i = 0; i + 1 < c.line.size(); ++i) {
            const PlotPixel &a = c.line[i], &b = c.line[i + 1];
            const double pixels = std::hypot(b.x - a.x, b.y - a.y);
            const int looks = int(std::clamp(pixels / step, 1.0, 1000.0));
            for (int k = 0; k <= looks; ++k) {
                const double x = a.x + (b.x - a.x) * k / looks, y = a.y + (b.y - a.y) * k / looks;
                if (x > left && x < right && y > top && y < bottom) length += pixels / looks;
            }
        }
    }
    return length;
}

// Prefers the lower left corner, since curves fall.
void lay_out_legend(PlotLayout& l, const Plot& plot, double em, const std::function<double(std::string_view)>& width) {
    std::vector<size_t> named;
    double widest = 0;
    for (size_t i = 0; i < plot.curves.size(); ++i) {
        if (plot.curves[i].name.empty()) continue;
        named.push_back(i);
        widest = std::max(widest, width(plot.curves[i].name));
    }
    const double line = 1.5 * em, full = 1.25 * l.legend_sample + widest, height = line * double(named.size());
    const double lower = l.bottom - 0.6 * em - height, upper = l.top + (l.marks.empty() ? 0.6 : 0.6 + 1.35 * label_rows) * em;
    const double left = l.left + 0.8 * em, right = l.right - 0.8 * em - full;
    const PlotPixel corners[] = {{left, lower}, {right, upper}, {right, lower}, {left, upper}};
    const auto cost = [&](const PlotPixel& at) {
        return covered(l, plot, at.x - em, at.y - em / 2, at.x + full + em, at.y + height + em / 2);
    };
    const PlotPixel best = *std::ranges::min_element(corners, {}, cost);
    for (size_t i = 0; i < named.size(); ++i)
        l.legend.push_back({named[i], {best.x + 1.25 * l.legend_sample, best.y + line * double(i) + 1.1 * em}});
}

} // namespace

double LogAxis::fraction(double value) const { return (std::log10(value) - low) / (high - low); }
double LogAxis::value(double fraction) const { return std::pow(10, low + fraction * (high - low)); }

PlotLayout compute_plot_layout(const Plot& plot, const PlotMetrics& metrics) {
    const double em = metrics.font_size;
    std::function<double(std::string_view)> width = metrics.text_width;
    if (!width) width = [em](std::string_view text) { return 0.55 * em * double(text.size()); };
    PlotLayout l;
    set_axes(l, plot);
    l.top = plot.title.empty() ? 0.8 * em : 2.8 * em;
    l.bottom = std::max(metrics.height - (plot.x_label.empty() ? 1.9 : 4.2) * em, l.top + 1);
    l.y_ticks = ticks_of(
        l.y_axis, [&](double v) { return l.py(v); }, [&](const std::string&) { return 1.4 * em; });
    double widest = 0;
    for (const PlotTick& t : l.y_ticks) widest = std::max(widest, width(t.text));
    l.left = widest + (plot.y_label.empty() ? 1 : 2.6) * em;
    l.right = std::max(metrics.width - 1.3 * em, l.left + 1);
    l.x_ticks = ticks_of(
        l.x_axis, [&](double v) { return l.px(v); }, [&](const std::string& text) { return width(text) + em; });
    for (size_t i = 0; i < plot.curves.size(); ++i) {
        PlotLayout::Curve c = lay_out_curve(l, plot.curves[i], i, em);
        if (!c.line.empty()) l.curves.push_back(std::move(c));
    }
    lay_out_marks(l, plot, em, width);
    for (const PlotLevel& level : plot.levels) {
        if (!(level.y > 0) || !std::isfinite(level.y)) continue;
        const double at = l.py(level.y);
        if (at >= l.top && at <= l.bottom) l.levels.push_back({at, {l.right - 0.5 * em, at - 0.35 * em}, level.label});
    }
    l.legend_sample = 2 * em;
    if (metrics.legend) lay_out_legend(l, plot, em, width);
    return l;
}

std::optional<PlotPick> pick(const Plot& plot, const PlotLayout& layout, double x, double y, double reach) {
    std::optional<PlotPick> nearest;
    double nearest_square = reach * reach;
    for (const PlotLayout::Curve& c : layout.curves) {
        if (plot.curves[c.index].dots == PlotCurve::Dots::none) continue;
        for (size_t i = 0; i < c.line.size(); ++i) {
            const double dx = c.line[i].x - x, dy = c.line[i].y - y, square = dx * dx + dy * dy;
            if (square > nearest_square) continue;
            nearest_square = square;
            nearest = PlotPick{c.index, c.points[i], c.line[i]};
        }
    }
    return nearest;
}

} // namespace blush
