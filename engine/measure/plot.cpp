#include "measure/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace blush {
namespace {

constexpr double left = 74, right = 16, top = 34, bottom = 50; // margins around the axes, CSS pixels
constexpr double legend_line = 18, longest_axis = 12;          // decades that still get minor lines: longest_axis

// Decades [low, high] that hold every positive value.
struct LogAxis {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

    void include(double value) {
        if (!(value > 0) || !std::isfinite(value)) return;
        low = std::min(low, std::log10(value));
        high = std::max(high, std::log10(value));
    }
    // A little room at both ends, and something to show if nothing was included.
    void finish() {
        if (!(low <= high)) low = -1, high = 1;
        const double room = std::max(0.04 * (high - low), 0.05);
        low -= room;
        high += room;
    }
    double fraction(double value) const { return (std::log10(value) - low) / (high - low); }
};

std::string tick_text(double value) {
    if (value >= 0.001 && value < 1e5) return fmt::format("{:g}", value);
    return fmt::format("1e{}", int(std::lround(std::log10(value))));
}

struct Axes {
    const Plot& plot;
    LogAxis x, y;
    double width() const { return plot.width - left - right; }
    double height() const { return plot.height - top - bottom; }
    double px(double v) const { return left + width() * x.fraction(v); }
    double py(double v) const { return top + height() * (1 - y.fraction(v)); }
};

Axes frame_of(const Plot& plot) {
    Axes f{plot, {}, {}};
    for (const PlotCurve& c : plot.curves) {
        for (const PlotCurve::Point& p : c.points) {
            if (!(p.x > 0) || !(p.y > 0)) continue;
            f.x.include(p.x);
            f.y.include(p.y);
        }
    }
    f.x.finish();
    f.y.finish();
    return f;
}

// Lines at 1, 2, ... 9 times each power of ten; numbers at the powers, and at 2 and 5 where there are few.
template <class Draw> void for_ticks(const LogAxis& axis, Draw draw) {
    const double decades = axis.high - axis.low;
    for (int e = int(std::floor(axis.low)); e <= int(std::ceil(axis.high)); ++e) {
        for (int m = 1; m < 10; ++m) {
            if (m > 1 && decades > longest_axis) break;
            const double value = m * std::pow(10.0, e), at = std::log10(value);
            if (at < axis.low || at > axis.high) continue;
            draw(value, m == 1, m == 1 || (decades < 2.5 && (m == 2 || m == 5)));
        }
    }
}

void draw_axes(std::string& svg, const Axes& f) {
    const double x0 = left, x1 = left + f.width(), y0 = top, y1 = top + f.height();
    for_ticks(f.x, [&](double v, bool major, bool labelled) {
        svg += fmt::format("<line x1='{0:.1f}' y1='{1}' x2='{0:.1f}' y2='{2}' class='{3}'/>\n", f.px(v), y0, y1, major ? "major" : "minor");
        if (labelled) svg += fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle'>{}</text>\n", f.px(v), y1 + 17, tick_text(v));
    });
    for_ticks(f.y, [&](double v, bool major, bool labelled) {
        svg += fmt::format("<line x1='{1}' y1='{0:.1f}' x2='{2}' y2='{0:.1f}' class='{3}'/>\n", f.py(v), x0, x1, major ? "major" : "minor");
        if (labelled) svg += fmt::format("<text x='{}' y='{:.1f}' text-anchor='end'>{}</text>\n", x0 - 7, f.py(v) + 4, tick_text(v));
    });
    svg += fmt::format("<rect x='{}' y='{}' width='{}' height='{}' class='box'/>\n", x0, y0, f.width(), f.height());
    const Plot& p = f.plot;
    svg += fmt::format("<text x='{}' y='20' class='title'>{}</text>\n", x0, escaped_markup(p.title));
    svg += fmt::format("<text x='{}' y='{}' text-anchor='middle'>{}</text>\n", (x0 + x1) / 2, p.height - 12, escaped_markup(p.x_label));
    svg += fmt::format("<text transform='translate(18 {}) rotate(-90)' text-anchor='middle'>{}</text>\n", (y0 + y1) / 2,
                       escaped_markup(p.y_label));
}

void draw_curve(std::string& svg, const Axes& f, const PlotCurve& c) {
    std::string line, dots;
    const double lowest = std::pow(10, f.y.low), highest = std::pow(10, f.y.high);
    for (const PlotCurve::Point& p : c.points) {
        if (!(p.x > 0) || !(p.y > 0) || !std::isfinite(p.y)) continue;
        line += fmt::format("{}{:.1f},{:.1f}", line.empty() ? "" : " ", f.px(p.x), f.py(p.y));
        if (c.dots) dots += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='2.6' fill='{}'/>\n", f.px(p.x), f.py(p.y), c.color);
        if (p.low > 0 && p.high > p.low)
            dots += fmt::format("<line x1='{0:.1f}' y1='{1:.1f}' x2='{0:.1f}' y2='{2:.1f}' stroke='{3}' stroke-opacity='0.45'/>\n",
                                f.px(p.x), f.py(std::clamp(p.low, lowest, highest)), f.py(std::clamp(p.high, lowest, highest)), c.color);
    }
    if (line.empty()) return;
    svg += fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='{}'{}/>\n", line, c.color, c.dashed ? 1.2 : 1.8,
                       c.dashed ? " stroke-dasharray='5 4'" : "");
    svg += dots;
}

// In the lower left corner: curves fall towards the right.
void draw_legend(std::string& svg, const Axes& f) {
    const auto named = [](const PlotCurve& c) { return !c.name.empty(); };
    const double count = double(std::count_if(f.plot.curves.begin(), f.plot.curves.end(), named));
    double y = top + f.height() - 10 - legend_line * (count - 1);
    for (const PlotCurve& c : f.plot.curves) {
        if (!named(c)) continue;
        svg += fmt::format("<line x1='{0}' y1='{1}' x2='{2}' y2='{1}' stroke='{3}' stroke-width='2.4'{4}/>\n", left + 10, y - 4, left + 32,
                           c.color, c.dashed ? " stroke-dasharray='5 4'" : "");
        svg += fmt::format("<text x='{}' y='{}' class='legend'>{}</text>\n", left + 38, y, escaped_markup(c.name));
        y += legend_line;
    }
}

void draw_marks(std::string& svg, const Axes& f) {
    for (const PlotMark& m : f.plot.marks) {
        if (!(m.x > 0) || f.x.fraction(m.x) < 0 || f.x.fraction(m.x) > 1) continue;
        svg += fmt::format("<line x1='{0:.1f}' y1='{1}' x2='{0:.1f}' y2='{2}' stroke='#888' stroke-dasharray='2 3'/>\n", f.px(m.x), top,
                           top + f.height());
        svg += fmt::format("<text x='{:.1f}' y='{}' class='legend'>{}</text>\n", f.px(m.x) + 3, top + 13, escaped_markup(m.label));
    }
}

} // namespace

std::string plot_color(size_t i) {
    constexpr std::array colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#5b5b5b", "#8c510a"};
    return colors[i % colors.size()];
}

PlotCurve plot_guide(const Plot& plot, double slope, const std::string& name) {
    PlotCurve guide{name, "#777777", {}, true, false};
    LogAxis x;
    const PlotCurve::Point* first = nullptr;
    for (const PlotCurve& c : plot.curves) {
        for (const PlotCurve::Point& p : c.points) {
            if (!(p.x > 0) || !(p.y > 0)) continue;
            x.include(p.x);
            if (!first || p.x < first->x) first = &p;
        }
    }
    if (!first) return guide;
    for (const double at : {x.low, x.high})
        guide.points.push_back({std::pow(10, at), first->y * std::pow(std::pow(10, at) / first->x, slope)});
    return guide;
}

std::string to_svg(const Plot& plot) {
    const Axes f = frame_of(plot);
    std::string svg = fmt::format("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
                                  "font-family='system-ui, sans-serif' font-size='12' fill='#333'>\n",
                                  plot.width, plot.height);
    svg += "<style>.minor{stroke:#eeeeee}.major{stroke:#d5d5d5}.box{fill:none;stroke:#999999}.title{font-size:14px;font-weight:600}"
           ".legend{paint-order:stroke;stroke:#ffffff;stroke-width:3px}</style>\n";
    svg += fmt::format("<rect width='{}' height='{}' fill='#ffffff'/>\n", plot.width, plot.height);
    draw_axes(svg, f);
    for (const PlotCurve& c : plot.curves) draw_curve(svg, f, c);
    draw_marks(svg, f);
    draw_legend(svg, f);
    return svg + "</svg>\n";
}

std::string escaped_markup(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '&': result += "&amp;"; break;
        case '<': result += "&lt;"; break;
        case '>': result += "&gt;"; break;
        case '"': result += "&quot;"; break;
        case '\'': result += "&#39;"; break;
        default: result += (unsigned char)c < 0x20 ? ' ' : c;
        }
    }
    return result;
}

} // namespace blush
