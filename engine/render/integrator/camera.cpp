#include "render/integrator/camera.h"

#include <cmath>
#include <numbers>

namespace blush {
namespace {

// Inverts the integral of `weight` over [-radius, radius] (pixels) at equal steps of probability.
template <class Weight> FilterTable invert(double radius, Weight weight) {
    constexpr int fine = 16384;
    std::array<double, fine + 1> cdf{};
    for (int i = 0; i < fine; ++i) cdf[size_t(i) + 1] = cdf[size_t(i)] + weight((i + 0.5) / fine);
    FilterTable table;
    size_t at = 0;
    for (int k = 0; k <= FilterTable::size; ++k) {
        const double target = cdf.back() * k / FilterTable::size;
        while (at + 1 < fine && cdf[at + 1] < target) ++at;
        const double step = cdf[at + 1] - cdf[at];
        const double x = (double(at) + (step > 0 ? (target - cdf[at]) / step : 0)) / fine;
        table.offset[size_t(k)] = float((2 * x - 1) * radius);
    }
    return table;
}

} // namespace

const FilterTable& blackman_harris_filter() {
    static const FilterTable table = invert(0.75, [](double x) {
        const double a = 2 * std::numbers::pi * x;
        return 0.35875 - 0.48829 * std::cos(a) + 0.14128 * std::cos(2 * a) - 0.01168 * std::cos(3 * a);
    });
    return table;
}

const FilterTable& box_filter() {
    static const FilterTable table = invert(0.5, [](double) { return 1.0; });
    return table;
}

} // namespace blush
