#include "measure/plot/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace blush {

std::string plot_color(size_t i) {
    constexpr std::array colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#5b5b5b", "#8c510a"};
    return colors[i % colors.size()];
}

std::string plot_color_on_dark(size_t i) {
    constexpr std::array colors{"#62aee8", "#f08a4b", "#3fc79a", "#e0a0c6", "#edb63e", "#9bd4f5", "#b4b4b4", "#c9975c"};
    return colors[i % colors.size()];
}

PlotCurve plot_guide(const Plot& plot, double slope, const std::string& name, const PlotCurve* along) {
    PlotCurve guide{name, "#777777", {}, PlotCurve::Line::dashed, PlotCurve::Dots::none};
    double low = std::numeric_limits<double>::infinity(), high = 0;
    const PlotCurve::Point* first = nullptr;
    const auto look_at = [&](const PlotCurve& c, bool pass_through) {
        for (const PlotCurve::Point& p : c.points) {
            if (!(p.x > 0) || !(p.y > 0)) continue;
            low = std::min(low, p.x);
            high = std::max(high, p.x);
            if (pass_through && (!first || p.x < first->x)) first = &p;
        }
    };
    for (const PlotCurve& c : plot.curves) look_at(c, !along);
    if (along) look_at(*along, true);
    if (!first) return guide;
    for (const double at : {low, high}) guide.points.push_back({at, first->y * std::pow(at / first->x, slope)});
    return guide;
}

} // namespace blush
