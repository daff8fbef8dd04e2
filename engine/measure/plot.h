// A log-log chart as plain data: whoever draws it asks plot_layout.h where things go.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace blush {

struct PlotCurve {
    struct Point {
        double x = 0, y = 0;
        double low = 0, high = 0; // 95 % interval of y, drawn as a band; both 0 for none
    };
    enum class Line { solid, dashed, dotted };
    enum class Dots { none, filled, hollow }; // one at each point; guides have none, and cannot be picked
    std::string name;                         // in the legend; empty: not there
    std::string color;                        // "#rrggbb"
    std::vector<Point> points;                // those that are not positive are left out
    Line line = Line::solid;
    Dots dots = Dots::filled;
};

// A vertical line at x: an edit, say.
struct PlotMark {
    double x = 0;
    std::string label;
    std::string color = "#888888";
};

// A horizontal line at y: a target.
struct PlotLevel {
    double y = 0;
    std::string label;
};

struct Plot {
    std::string title, x_label, y_label;
    std::vector<PlotCurve> curves;
    std::vector<PlotMark> marks;
    std::vector<PlotLevel> levels;
    int width = 640, height = 420; // CSS pixels
};

// The colour of the i-th of a few curves on white: told apart by people who do not see red from green too (Okabe and Ito 2008).
std::string plot_color(size_t i);
// The same for a dark ground: the same hues, in the same order, as light as they have to be.
std::string plot_color_on_dark(size_t i);

// y = y0 (x / x0)^slope over the range of the curves' x, dashed, through the first point of `along`, or of all: the guide to compare
// slopes with.
PlotCurve plot_guide(const Plot& plot, double slope, const std::string& name, const PlotCurve* along = nullptr);

} // namespace blush
