// Where everything of a log-log chart goes, in pixels: axes, ticks, curves, marks, legend, and what is under the mouse. Pure; the SVG and
// the window draw the same layout.
#pragma once

#include "measure/plot.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// The decades from `low` to `high`, both powers of ten.
struct LogAxis {
    double low = -1, high = 1;
    double fraction(double value) const; // 0 at the low end, 1 at the high one
    double value(double fraction) const;
};

struct PlotTick {
    double value = 0, at = 0; // `at`: pixels
    bool major = false;       // a power of ten
    std::string text;         // empty where there is no room, or no need
};

struct PlotPixel {
    double x = 0, y = 0;
};

struct PlotLayout {
    struct Curve {
        size_t index = 0; // of the plot's curves
        std::vector<PlotPixel> line;
        std::vector<size_t> points;  // which of the curve's points each of `line` is
        std::vector<PlotPixel> dots; // those of `line` that have room for one; none for a guide
        std::vector<PlotPixel> band; // around the interval: along its upper edge, then back along the lower one; empty for none
    };
    struct Mark {
        double at = 0;
        PlotPixel text;    // left end of the label's baseline
        std::string label; // empty where there is no room
        std::string color;
    };
    struct Level {
        double at = 0;
        PlotPixel text; // right end of the label's baseline
        std::string label;
    };
    struct Entry {
        size_t curve = 0; // of the plot's curves
        PlotPixel text;   // left end of the baseline; the sample of its line is before it
    };

    double left = 0, top = 0, right = 0, bottom = 0; // of the axes
    LogAxis x_axis, y_axis;
    std::vector<PlotTick> x_ticks, y_ticks;
    std::vector<Curve> curves; // in the order of drawing; those without a point are left out
    std::vector<Mark> marks;
    std::vector<Level> levels;
    std::vector<Entry> legend; // in the corner where it covers the least of the curves
    double legend_sample = 0;  // length of a line's sample, and it ends a quarter of that before the text

    double px(double x) const { return left + (right - left) * x_axis.fraction(x); }
    double py(double y) const { return bottom - (bottom - top) * y_axis.fraction(y); }
};

struct PlotMetrics {
    double width = 640, height = 420; // pixels
    double font_size = 12;            // all distances follow from it
    bool legend = true;
    std::function<double(std::string_view)> text_width = {}; // pixels; empty: guessed from the number of letters
};

// Axes begin and end at 1, 2 or 5 times a power of ten, so that a growing curve does not make them creep, with a little room, and span
// at least half a decade. What is not positive and finite is nowhere.
PlotLayout lay_out(const Plot& plot, const PlotMetrics& metrics);

// The point nearest to (x, y), not further than `reach` pixels.
struct PlotPick {
    size_t curve = 0, point = 0; // of the plot's
    PlotPixel at;
};
std::optional<PlotPick> pick(const Plot& plot, const PlotLayout& layout, double x, double y, double reach);

} // namespace blush
