// Layout of a log-log chart in pixels: axes, ticks, curves, marks, legend, picking. Pure functions; the SVG and the window draw
// the same layout.
#pragma once

#include "measure/plot/plot.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// Logarithmic axis from 10^low to 10^high.
struct LogAxis {
    double low = -1, high = 1;
    double fraction(double value) const; // 0 at the low end, 1 at the high end
    double value(double fraction) const;
};

struct PlotTick {
    double value = 0, at = 0; // `at`: pixels
    bool major = false;       // a power of ten
    std::string text;         // empty if there is no room or no label
};

struct PlotPixel {
    double x = 0, y = 0;
};

struct PlotLayout {
    struct Curve {
        size_t index = 0; // of the plot's curves
        std::vector<PlotPixel> line;
        std::vector<size_t> points;  // index of the curve's point for each vertex of `line`
        std::vector<PlotPixel> dots; // subset of `line` with room for a marker; none for a guide
        std::vector<PlotPixel> band; // polygon of the interval: upper edge, then back along the lower one; empty if none
    };
    struct Mark {
        double at = 0;
        PlotPixel text;    // left end of the label's baseline
        std::string label; // empty if there is no room
        std::string color;
    };
    struct Level {
        double at = 0;
        PlotPixel text; // right end of the label's baseline
        std::string label;
    };
    struct Entry {
        size_t curve = 0; // of the plot's curves
        PlotPixel text;   // left end of the baseline; the line sample is left of it
    };

    double left = 0, top = 0, right = 0, bottom = 0; // rectangle of the axes
    LogAxis x_axis, y_axis;
    std::vector<PlotTick> x_ticks, y_ticks;
    std::vector<Curve> curves; // in drawing order, without curves that have no points
    std::vector<Mark> marks;
    std::vector<Level> levels;
    std::vector<Entry> legend; // in the corner where it covers the curves least
    double legend_sample = 0;  // length of a line sample; the gap to the text is a quarter of it

    double px(double x) const { return left + (right - left) * x_axis.fraction(x); }
    double py(double y) const { return bottom - (bottom - top) * y_axis.fraction(y); }
};

struct PlotMetrics {
    double width = 640, height = 420; // pixels
    double font_size = 12;            // all distances scale with it
    bool legend = true;
    std::function<double(std::string_view)> text_width = {}; // pixels; empty: estimated from the number of characters
};

// Axes begin and end at 1, 2 or 5 times a power of ten with a small margin, so that they change rarely while a curve grows, and
// span at least half a decade. Values that are not positive and finite are skipped.
PlotLayout compute_plot_layout(const Plot& plot, const PlotMetrics& metrics);

// The point nearest to (x, y) within `reach` pixels.
struct PlotPick {
    size_t curve = 0, point = 0; // of the plot's
    PlotPixel at;
};
std::optional<PlotPick> pick(const Plot& plot, const PlotLayout& layout, double x, double y, double reach);

} // namespace blush
