#include "measure/intervals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace blush {

double normal_two_sided(double z) { return std::erfc(std::abs(z) / std::numbers::sqrt2); }

double normal_quantile_two_sided(double p) {
    double low = 0, high = 40;
    for (int i = 0; i < 80; ++i) {
        const double middle = (low + high) / 2;
        (normal_two_sided(middle) > p ? low : high) = middle;
    }
    return low;
}

double student_95(int64_t degrees) {
    constexpr double few[]{12.7062, 4.3027, 3.1824};
    if (degrees <= 3) return few[std::max<int64_t>(degrees, 1) - 1];
    const double z = 1.959964, n = double(degrees), z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
    return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) + (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n);
}

Interval mean_interval(std::span<const double> values) {
    Interval result;
    if (values.empty()) return result;
    const double n = double(values.size());
    result.value = result.low = result.high = std::accumulate(values.begin(), values.end(), 0.0) / n;
    if (values.size() < 2) return result;
    double squares = 0;
    for (const double v : values) squares += (v - result.value) * (v - result.value);
    const double margin = student_95(int64_t(values.size()) - 1) * std::sqrt(squares / (n - 1) / n);
    return {true, result.value, result.value - margin, result.value + margin};
}

PowerFit fit_power(std::span<const double> x, std::span<const double> y) {
    const size_t count = std::min(x.size(), y.size());
    if (count < 3) return {};
    const double n = double(count);
    double mean_x = 0, mean_y = 0;
    for (size_t i = 0; i < count; ++i) mean_x += std::log(x[i]) / n, mean_y += std::log(y[i]) / n;
    double xx = 0, xy = 0;
    for (size_t i = 0; i < count; ++i) {
        const double dx = std::log(x[i]) - mean_x;
        xx += dx * dx;
        xy += dx * (std::log(y[i]) - mean_y);
    }
    if (!(xx > 1e-12) || !std::isfinite(xy)) return {};
    const double slope = xy / xx;
    double rest = 0;
    for (size_t i = 0; i < count; ++i) {
        const double off = std::log(y[i]) - mean_y - slope * (std::log(x[i]) - mean_x);
        rest += off * off;
    }
    const double margin = student_95(int64_t(count) - 2) * std::sqrt(rest / (n - 2) / xx);
    return {{true, slope, slope - margin, slope + margin}, std::exp(mean_y - slope * mean_x)};
}

double reach(const PowerFit& fit, double y) {
    if (!fit.slope.known || fit.slope.value >= 0 || !(y > 0)) return 0;
    return std::pow(y / fit.at_one, 1 / fit.slope.value);
}

} // namespace blush
