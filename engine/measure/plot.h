// A log-log chart as plain data, and that data as SVG: for reports and for the window's export.
#pragma once

#include <string>
#include <vector>

namespace blush {

struct PlotCurve {
    struct Point {
        double x = 0, y = 0;
        double low = 0, high = 0; // 95 % interval of y; both 0 for none
    };
    std::string name;          // in the legend; empty: not there
    std::string color;         // "#rrggbb"
    std::vector<Point> points; // those that are not positive are left out
    bool dashed = false;       // guides
    bool dots = true;          // one at each point
};

struct PlotMark {
    double x = 0;
    std::string label;
};

struct Plot {
    std::string title, x_label, y_label;
    std::vector<PlotCurve> curves;
    std::vector<PlotMark> marks;   // vertical lines
    int width = 640, height = 420; // CSS pixels
};

// The colour of the i-th of a few curves: told apart by people who do not see red from green too (Okabe and Ito 2008).
std::string plot_color(size_t i);

// y = y0 (x / x0)^slope over the range of the other curves' x, dashed, through their first point: the guide to compare slopes with.
PlotCurve plot_guide(const Plot& plot, double slope, const std::string& name);

// An <svg> element that stands alone: its own text sizes and colours, no script, no outside resource.
std::string to_svg(const Plot& plot);

// Text inside HTML or SVG, quotes too; control characters, which XML does not allow, become spaces.
std::string escaped_markup(const std::string& text);

} // namespace blush
