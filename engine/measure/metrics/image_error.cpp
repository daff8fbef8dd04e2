#include "measure/metrics/image_error.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr double floor_of_relmse = 0.01; // as in metrics.h

// Sum over pixels and its variance.
struct Scatter {
    double sum = 0, squares = 0;
    void add(double v) { sum += v, squares += v * v; }
    Interval mean(double n) const {
        const double m = sum / n, error = 1.96 * std::sqrt(std::max(0.0, squares / n - m * m) / n);
        return {m > error, std::max(0.0, m), std::max(0.0, m - error), m + error};
    }
};

size_t count_of(const PixelView& image) { return image.values.size() / size_t(image.stride); }

Interval root(const Interval& i) { return {i.known, std::sqrt(i.value), std::sqrt(i.low), std::sqrt(i.high)}; }

// Interval distance -+ reach of a norm.
Interval about(double distance, double reach) { return {2 * reach < distance, distance, distance - reach, distance + reach}; }
Interval squared(const Interval& i) { return {i.known, i.value * i.value, i.low * i.low, i.high * i.high}; }

} // namespace

ImageError error_against(const PixelView& image, const MeasuredImage& reference) {
    Scatter absolute, relative;
    size_t count = 0;
    for (size_t i = 0, n = std::min(count_of(image), reference.image.pixels.size()); i < n; ++i) {
        const float* p = &image.values[i * size_t(image.stride)];
        const Vec3 &r = reference.image.pixels[i], &e = reference.error[i];
        const auto square = [](double at, double about, double error) { return (at - about) * (at - about) - error * error; };
        const auto divided = [](double s, double about) { return s / (about * about + floor_of_relmse); };
        const double x = square(p[0], r.x, e.x), y = square(p[1], r.y, e.y), z = square(p[2], r.z, e.z);
        if (!std::isfinite(x + y + z)) continue;
        ++count;
        absolute.add((x + y + z) / 3);
        relative.add((divided(x, r.x) + divided(y, r.y) + divided(z, r.z)) / 3);
    }
    if (count < 2) return {};
    return {root(absolute.mean(double(count))), relative.mean(double(count))};
}

ImageError error_against(const PixelView& image, const PixelView& raw, const ErrorEstimate& raw_error) {
    double absolute = 0, relative = 0;
    size_t count = 0;
    for (size_t i = 0, n = std::min(count_of(image), count_of(raw)); i < n; ++i) {
        const float *p = &image.values[i * size_t(image.stride)], *r = &raw.values[i * size_t(raw.stride)];
        double own = 0, over = 0;
        for (int k = 0; k < 3; ++k) {
            const double d = double(p[k]) - double(r[k]);
            own += d * d;
            over += d * d / (double(r[k]) * double(r[k]) + floor_of_relmse);
        }
        if (!std::isfinite(own)) continue;
        ++count;
        absolute += own;
        relative += over;
    }
    if (count == 0) return {};
    ImageError e;
    if (raw_error.rmse_known) e.rmse = about(std::sqrt(absolute / (3 * double(count))), raw_error.rmse_high);
    if (raw_error.known) e.relmse = squared(about(std::sqrt(relative / (3 * double(count))), std::sqrt(raw_error.high)));
    return e;
}

ConvergencePoint estimated_point(const Frame& frame) {
    const ErrorEstimate& e = frame.error;
    ConvergencePoint p{ConvergencePoint::Kind::estimated, frame.error_at, frame.error_samples, {}, {}};
    if (e.rmse_known) p.rmse = {true, e.rmse, e.rmse_low, e.rmse_high};
    if (e.known) p.relmse = {true, e.relmse, e.low, e.high};
    return p;
}

} // namespace blush
