#include "render/error_estimate.h"

#include <algorithm>
#include <cmath>

namespace blush {

void ErrorAccumulator::add(const Vec3d& a, const Vec3d& b, double weight_a) {
    const double weight_b = 1 - weight_a;
    const auto channel = [&](double x, double y) {
        const double mean = weight_a * x + weight_b * y;
        return (x - y) * (x - y) * weight_a * weight_b / (mean * mean + 0.01);
    };
    const double e = (channel(a.x, b.x) + channel(a.y, b.y) + channel(a.z, b.z)) / 3;
    ++pixels_;
    sum_ += e;
    sum_squares_ += e * e;
}

void ErrorAccumulator::merge(const ErrorAccumulator& other) {
    pixels_ += other.pixels_;
    sum_ += other.sum_;
    sum_squares_ += other.sum_squares_;
}

ErrorEstimate ErrorAccumulator::estimate() const {
    if (pixels_ < 64) return {};
    const double n = double(pixels_);
    const double mean = sum_ / n;
    const double variance = std::max(0.0, sum_squares_ / n - mean * mean) / (n - 1);
    const double margin = 1.96 * std::sqrt(variance);
    return {true, mean, std::max(0.0, mean - margin), mean + margin};
}

ErrorEstimate widened(const ErrorEstimate& estimate, int sharing) {
    const double k = std::sqrt(double(sharing));
    ErrorEstimate e = estimate;
    e.low = std::max(0.0, e.relmse - (e.relmse - e.low) * k);
    e.high = e.relmse + (e.high - e.relmse) * k;
    return e;
}

} // namespace blush
