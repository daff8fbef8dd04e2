// Statistics for tests: every bound follows from a significance and from variance that was measured or is known, never from a
// hand-tuned tolerance. A failing test prints its numbers.
#pragma once

#include "core/vec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace blush::statistics {

// Probability that a test of correct code fails. Seeds are fixed, so it applied once, when the test was written.
constexpr double significance = 0.01;

// Significance of each of `count` independent tests that together have `overall` (Sidak 1967).
inline double sidak(double overall, int64_t count) { return -std::expm1(std::log1p(-overall) / double(count)); }

// ---- means

// Running mean and variance (Welford 1962).
struct Moments {
    int64_t count = 0;
    double mean = 0, squares = 0; // sum of squared deviations

    void add(double x) {
        const double before = x - mean;
        mean += before / double(++count);
        squares += before * (x - mean);
    }
    double variance() const { return count > 1 ? squares / double(count - 1) : 0; }
    double error() const { return count > 0 ? std::sqrt(variance() / double(count)) : 0; } // of the mean, one sigma
};

// Moments of `count` values of draw().
template <class Fn> Moments estimate(int64_t count, Fn draw) {
    Moments m;
    for (int64_t i = 0; i < count; ++i) m.add(double(draw()));
    return m;
}

// Probability of a standard normal beyond +-z.
inline double normal_p(double z) { return std::erfc(std::abs(z) / std::numbers::sqrt2); }

// Relative rounding error allowed for some dozen single-precision operations: the tolerance where the variance is 0.
constexpr double float_rounding = 64 * 0x1p-24;

inline testing::AssertionResult z_verdict(const char* claim, double difference, double error, double scale, double alpha) {
    const double excess = std::max(0.0, std::abs(difference) - float_rounding * std::abs(scale));
    const double p = excess == 0 ? 1 : error > 0 ? normal_p(excess / error) : 0;
    if (p >= alpha) return testing::AssertionSuccess();
    return testing::AssertionFailure() << claim << ": off by " << difference << ", standard error " << error << ", p = " << p << " < "
                                       << alpha;
}

// Tests that the mean is `expected`.
inline testing::AssertionResult z_test(const Moments& m, double expected, double alpha = significance) {
    if (!std::isfinite(m.mean)) return testing::AssertionFailure() << "mean is " << m.mean;
    return z_verdict("mean differs", m.mean - expected, m.error(), expected, alpha)
           << " (mean of " << m.count << " is " << m.mean << ", expected " << expected << ")";
}
// The same for numbers that lie in [low, high]. Uses the largest possible variance (Bhatia and Davis 2000): if the sample misses rare
// large values, its own variance is too small.
inline testing::AssertionResult z_test_in_range(const Moments& m, double low, double high, double expected, double alpha = significance) {
    const double variance = std::max(0.0, expected - low) * std::max(0.0, high - expected);
    return z_verdict("mean differs", m.mean - expected, std::sqrt(variance / double(m.count)), expected, alpha)
           << " (mean of " << m.count << " is " << m.mean << ", expected " << expected << ")";
}
// Tests that the mean is at most `limit`.
inline testing::AssertionResult z_test_at_most(const Moments& m, double limit, double alpha = significance) {
    if (!std::isfinite(m.mean)) return testing::AssertionFailure() << "mean is " << m.mean;
    return z_verdict("mean exceeds", std::max(0.0, m.mean - limit), m.error(), limit, 2 * alpha)
           << " (mean of " << m.count << " is " << m.mean << ", limit " << limit << ")";
}
// Tests that two independent samples have the same mean.
inline testing::AssertionResult same_mean(const Moments& a, const Moments& b, double alpha = significance) {
    if (!std::isfinite(a.mean) || !std::isfinite(b.mean)) return testing::AssertionFailure() << "means are " << a.mean << ", " << b.mean;
    return z_verdict("means differ", a.mean - b.mean, std::hypot(a.error(), b.error()), std::max(std::abs(a.mean), std::abs(b.mean)), alpha)
           << " (means " << a.mean << " of " << a.count << " and " << b.mean << " of " << b.count << ")";
}

// ---- chi-squared

// Regularised upper incomplete gamma function Q(a, x): power series below a + 1, continued fraction (Lentz) above
// (Abramowitz and Stegun 6.5.29 and 6.5.31).
inline double gamma_q(double a, double x) {
    if (!(x > 0)) return 1;
    const double front = std::exp(-x + a * std::log(x) - std::lgamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (double n = a + 1; term > sum * 1e-15; ++n) sum += term *= x / n;
        return 1 - front * sum;
    }
    double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
    for (int i = 1; i < 100000; ++i) {
        const double an = -i * (i - a);
        b += 2;
        d = 1 / (an * d + b);
        c = b + an / c;
        h *= d * c;
        if (std::abs(d * c - 1) < 1e-15) break;
    }
    return front * h;
}

// Chi-squared test of counts against their expected values, which have the same sum. Cells with an expected value below 5 are pooled; if
// the pool is still below 5, the next larger cells join it.
inline testing::AssertionResult chi_squared_test(std::span<const int64_t> counts, std::span<const double> expected,
                                                 double alpha = significance) {
    struct Cell {
        size_t index;
        double count, expected, chi;
    };
    std::vector<Cell> cells;
    Cell pool{counts.size(), 0, 0, 0};
    for (size_t i = 0; i < counts.size(); ++i) {
        if (expected[i] >= 5)
            cells.push_back({i, double(counts[i]), expected[i], 0});
        else
            pool.count += double(counts[i]), pool.expected += expected[i];
    }
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.expected > b.expected; });
    while (pool.expected < 5 && !cells.empty()) {
        pool.count += cells.back().count, pool.expected += cells.back().expected;
        cells.pop_back();
    }
    cells.push_back(pool);
    double chi = 0;
    for (Cell& c : cells) {
        const double d = c.count - c.expected;
        c.chi = d == 0 ? 0 : c.expected > 0 ? d * d / c.expected : INFINITY;
        chi += c.chi;
    }
    const double freedom = std::max<double>(1, double(cells.size()) - 1);
    const double p = std::isfinite(chi) ? gamma_q(freedom / 2, chi / 2) : 0;
    if (p >= alpha) return testing::AssertionSuccess();
    std::ostringstream worst;
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.chi > b.chi; });
    for (size_t i = 0; i < std::min<size_t>(12, cells.size()); ++i)
        worst << "\n  cell " << (cells[i].index == counts.size() ? "(pool)" : std::to_string(cells[i].index)) << ": " << cells[i].count
              << " counted, " << cells[i].expected << " expected, chi2 " << cells[i].chi;
    return testing::AssertionFailure() << "chi2 = " << chi << " for " << freedom << " degrees of freedom, p = " << p << " < " << alpha
                                       << "; the cells that differ most:" << worst.str();
}

// ---- directions

// Maps the unit square to a part of the sphere, so that a grid can be fine where the measured lobe is narrow.
struct Chart {
    struct Point {
        Vec3d direction;
        double solid_angle; // per unit of the square
    };
    std::function<std::optional<Point>(double s, double t)> at;                    // none: no direction there
    std::function<std::optional<std::array<double, 2>>(const Vec3d&)> coordinates; // none: outside
};

// The whole sphere, equal areas.
inline Chart sphere_chart() {
    constexpr double pi = std::numbers::pi;
    return {[](double s, double t) -> std::optional<Chart::Point> {
                const double z = 1 - 2 * s, r = std::sqrt(1 - z * z), phi = (2 * t - 1) * pi;
                return Chart::Point{{r * std::cos(phi), r * std::sin(phi), z}, 4 * pi};
            },
            [](const Vec3d& w) {
                return std::optional(std::array{(1 - w.z) / 2, std::atan2(w.y, w.x) / (2 * pi) + 0.5});
            }};
}

struct DirectionTest {
    std::vector<Chart> charts = {sphere_chart()}; // disjoint; together they cover all sampled directions
    int rows = 16, columns = 16;                  // cells of each chart
    int points = 16;                              // of the midpoint rule, along each side of a cell
    int64_t samples = 100'000;
    double alpha = significance;
};

// Integrals of density(direction) over the cells of a chart, by the midpoint rule along both sides of a cell. Steps in s end at the
// chart's edge.
template <class Density> std::vector<double> integrate_cells(const Chart& chart, int rows, int columns, int points, Density density) {
    std::vector<double> cells(size_t(rows * columns));
    const int steps = rows * points, lines = columns * points;
    for (int line = 0; line < lines; ++line) {
        const double t = (line + 0.5) / lines;
        bool inside = chart.at(0, t).has_value();
        for (int step = 0; step < steps; ++step) {
            double low = double(step) / steps, high = double(step + 1) / steps;
            const bool began_inside = inside;
            inside = chart.at(high, t).has_value();
            if (began_inside != inside) {
                double in = began_inside ? low : high, out = began_inside ? high : low;
                for (int i = 0; i < 30; ++i) (chart.at((in + out) / 2, t) ? in : out) = (in + out) / 2;
                (began_inside ? high : low) = in;
            } else if (!inside) {
                continue;
            }
            if (const auto p = chart.at((low + high) / 2, t))
                cells[size_t(step / points * columns + line / points)] += p->solid_angle * density(p->direction) * (high - low) / lines;
        }
    }
    return cells;
}

// Tests that the directions of draw() -> optional<Vec3> follow the density pdf(Vec3) per solid angle. If the pdf integrates to less than 1,
// draw() must return none with the remaining probability.
template <class Draw, class Pdf> testing::AssertionResult directions_follow(const DirectionTest& test, Draw draw, Pdf pdf) {
    const auto density = [&](const Vec3d& w) { return double(pdf(Vec3{float(w.x), float(w.y), float(w.z)})); };
    std::vector<double> expected;
    for (const Chart& chart : test.charts)
        for (const double p : integrate_cells(chart, test.rows, test.columns, test.points, density))
            expected.push_back(p * double(test.samples));
    const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
    // The last cell counts "none". A pdf that integrates to more than 1, beyond the sampling error, gives it a negative expected count.
    expected.push_back(double(test.samples) - total);
    if (expected.back() < 0 && -expected.back() <= std::sqrt(double(test.samples))) expected.back() = 0;
    if (expected.back() < 0) return testing::AssertionFailure() << "the density integrates to " << total / double(test.samples);

    std::vector<int64_t> counts(expected.size());
    for (int64_t i = 0; i < test.samples; ++i) {
        size_t cell = counts.size() - 1;
        if (const std::optional<Vec3> w = draw())
            for (size_t c = 0; c < test.charts.size(); ++c)
                if (const auto st = test.charts[c].coordinates({w->x, w->y, w->z})) {
                    const int row = std::clamp(int((*st)[0] * test.rows), 0, test.rows - 1);
                    const int column = std::clamp(int((*st)[1] * test.columns), 0, test.columns - 1);
                    cell = (c * size_t(test.rows) + size_t(row)) * size_t(test.columns) + size_t(column);
                }
        ++counts[cell];
    }
    return chi_squared_test(counts, expected, test.alpha);
}

} // namespace blush::statistics
