// A log-log chart as plain data; plot_layout.h computes the layout for drawing.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace blush {

struct PlotCurve {
    struct Point {
        double x = 0, y = 0;
        double low = 0, high = 0; // 95 % interval of y, drawn as a band; both 0: none
    };
    enum class Line { solid, dashed, dotted };
    enum class Dots { none, filled, hollow }; // markers of the points; guides have none and cannot be picked
    std::string name;                         // in the legend; empty: not listed
    std::string color;                        // "#rrggbb"
    std::vector<Point> points;                // points that are not positive are skipped
    Line line = Line::solid;
    Dots dots = Dots::filled;
};

// A vertical line at x, such as an edit.
struct PlotMark {
    double x = 0;
    std::string label;
    std::string color = "#888888";
};

// A horizontal line at y, such as a target.
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

// Colour of the i-th curve on white, distinguishable with colour blindness (Okabe and Ito 2008).
std::string plot_color(size_t i);
// The same hues for a dark background, lightened as needed.
std::string plot_color_on_dark(size_t i);

// Guide line for slopes: y = y0 (x / x0)^slope over the x range of the curves, dashed, through the first point of `along` or,
// without it, of all curves.
PlotCurve plot_guide(const Plot& plot, double slope, const std::string& name, const PlotCurve* along = nullptr);

} // namespace blush
