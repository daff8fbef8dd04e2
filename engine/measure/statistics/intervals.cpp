#include "measure/statistics/intervals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace blush {
namespace {

// y = one * log at_one + x * slope, with errors of equal variance.
struct Equation {
    double one = 0, x = 0, y = 0;
};

// Least squares.
PowerFit solve(std::span<const Equation> equations) {
    if (equations.size() < 3) return {};
    double one_one = 0, one_x = 0, one_y = 0, xx = 0, xy = 0;
    for (const Equation& e : equations) {
        one_one += e.one * e.one;
        one_x += e.one * e.x;
        one_y += e.one * e.y;
    }
    // Uses the residual of x after projection on the constant: a difference of large sums would lose precision.
    for (const Equation& e : equations) {
        const double dx = e.x - e.one * one_x / one_one;
        xx += dx * dx;
        xy += dx * (e.y - e.one * one_y / one_one);
    }
    if (!(xx > 1e-12) || !std::isfinite(xy)) return {};
    const double slope = xy / xx, constant = (one_y - slope * one_x) / one_one;
    double rest = 0;
    for (const Equation& e : equations) {
        const double off = e.y - constant * e.one - slope * e.x;
        rest += off * off;
    }
    const auto degrees = int64_t(equations.size()) - 2;
    const double margin = student_95(degrees) * std::sqrt(rest / double(degrees) / xx);
    return {{true, slope, slope - margin, slope + margin}, std::exp(constant)};
}

} // namespace

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
    std::vector<Equation> equations(count);
    for (size_t i = 0; i < count; ++i) equations[i] = {1, std::log(x[i]), std::log(y[i])};
    return solve(equations);
}

PowerFit fit_running(std::span<const double> x, std::span<const double> y, std::span<const double> samples) {
    const size_t count = std::min({x.size(), y.size(), samples.size()});
    std::vector<Equation> equations;
    for (size_t i = 0; i < count; ++i) {
        const Equation own{1, std::log(x[i]), std::log(y[i])};
        if (i == 0) {
            equations.push_back(own);
            continue;
        }
        // Innovation since the previous point, divided by its standard deviation.
        const double shared = samples[i - 1] / samples[i];
        if (!(shared < 1)) continue;
        const double scale = 1 / std::sqrt(1 - shared * shared);
        const Equation before{1, std::log(x[i - 1]), std::log(y[i - 1])};
        const auto rest = [&](double now, double then) { return scale * (now - shared * then); };
        equations.push_back({rest(own.one, before.one), rest(own.x, before.x), rest(own.y, before.y)});
    }
    return solve(equations);
}

double reach(const PowerFit& fit, double y) {
    if (!fit.slope.known || fit.slope.value >= 0 || !(y > 0)) return 0;
    return std::pow(y / fit.at_one, 1 / fit.slope.value);
}

} // namespace blush
