#include "render/error_estimate.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr int reach = 2; // of the surroundings, pixels
constexpr int64_t fewest_pixels = 64;
constexpr double fewest_degrees = 4;
constexpr double widest = 100;
// Of the logarithm of the largest over the smallest estimate of relmse: one standard deviation.
constexpr double share_of_choice = 0.15;
// The half with one sample more has less variance than its share if points are well distributed; one standard deviation of what that is
// worth, per difference of the halves' weights. At most 1 for points whose variance falls with the square of their number.
constexpr double share_of_inequality = 0.75;

// Half width of a 95 % interval of the logarithm of F with n degrees of freedom twice, whose variance is about v = 4 / n: within 1 % for
// n >= 2 of tabulated quantiles.
double log_interval(double v) { return 1.96 * std::sqrt(v) * (1 + 0.16 * v); }

int clipped_count(int at, int size) { return std::min(at + reach, size - 1) - std::max(at - reach, 0) + 1; }

} // namespace

Surroundings::Surroundings(std::span<const float> rgba, int width, int height, int first_row, int last_row)
    : width_(width), height_(height), first_(std::max(0, first_row - reach)) {
    const int last = std::min(height, last_row + reach);
    sums_.resize(size_t(last - first_) * size_t(width));
    for (int y = first_; y < last; ++y) {
        const float* row = &rgba[4 * size_t(y) * size_t(width)];
        Vec3* sums = &sums_[size_t(y - first_) * size_t(width)];
        for (int x = 0; x < width; ++x) {
            Vec3 sum{0, 0, 0};
            for (int i = std::max(0, x - reach), end = std::min(width - 1, x + reach); i <= end; ++i) {
                sum.x += row[4 * i];
                sum.y += row[4 * i + 1];
                sum.z += row[4 * i + 2];
            }
            sums[x] = sum;
        }
    }
}

Vec3d Surroundings::mean(int x, int y) const {
    Vec3d sum{0, 0, 0};
    for (int i = std::max(0, y - reach), end = std::min(height_ - 1, y + reach); i <= end; ++i) {
        const Vec3& row = sums_[size_t(i - first_) * size_t(width_) + size_t(x)];
        sum = {sum.x + double(row.x), sum.y + double(row.y), sum.z + double(row.z)};
    }
    const double inverse = 1.0 / (clipped_count(x, width_) * clipped_count(y, height_));
    return {sum.x * inverse, sum.y * inverse, sum.z * inverse};
}

void ErrorAccumulator::add(const Vec3d& a, const Vec3d& b, double weight_a, const Vec3d& around) {
    const double weight_b = 1 - weight_a;
    double absolute = 0, relative = 0;
    const auto channel = [&](double x, double y, double near) {
        const double square = (x - y) * (x - y) * weight_a * weight_b;
        const double own = weight_a * x + weight_b * y;
        const auto divided = [&](double value) { return square / (value * value + 0.01); };
        absolute += square;
        relative += divided(std::min(own, near));
        relative_low_ += divided(std::max(own, near));
        relative_high_ += divided(std::min({x, y, near}));
    };
    channel(a.x, b.x, around.x);
    channel(a.y, b.y, around.y);
    channel(a.z, b.z, around.z);
    ++pixels_;
    absolute_.add(absolute);
    relative_.add(relative);
    unequal_ += std::abs(weight_a - weight_b) * absolute;
}

void ErrorAccumulator::merge(const ErrorAccumulator& other) {
    pixels_ += other.pixels_;
    absolute_.merge(other.absolute_);
    relative_.merge(other.relative_);
    relative_low_ += other.relative_low_;
    relative_high_ += other.relative_high_;
    unequal_ += other.unequal_;
}

// Of the logarithm of true error over estimate, relative variances being small; colours are taken to err together.
double ErrorAccumulator::log_variance(const Sums& sums) const {
    const double inequality = share_of_inequality * unequal_ / absolute_.squares;
    return 4.0 / 3 * sums.fourths / (sums.squares * sums.squares) + inequality * inequality;
}

ErrorEstimate ErrorAccumulator::estimate() const {
    ErrorEstimate e;
    if (pixels_ < fewest_pixels) return e;
    e.known = e.rmse_known = true;
    if (absolute_.squares == 0) return e; // no noise at all

    const double values = 3 * double(pixels_);
    const double absolute_variance = log_variance(absolute_);
    const double absolute_width = log_interval(absolute_variance);
    e.rmse_known = absolute_variance <= 4 / fewest_degrees;
    e.rmse = std::sqrt(absolute_.squares / values);
    e.rmse_low = e.rmse * std::exp(-absolute_width / 2);
    e.rmse_high = e.rmse * std::exp(absolute_width / 2);

    const double choice = share_of_choice * std::log(relative_high_ / relative_low_);
    const double relative_variance = log_variance(relative_) + choice * choice;
    const double relative_width = log_interval(relative_variance);
    e.known = log_variance(relative_) <= 4 / fewest_degrees && 2 * relative_width <= std::log(widest);
    e.relmse = relative_.squares / values;
    e.low = e.relmse * std::exp(-relative_width);
    e.high = e.relmse * std::exp(relative_width);
    return e;
}

ErrorEstimate widened(const ErrorEstimate& estimate, int sharing) {
    // Variances grow by the number of those that share, widths of logarithms by its root.
    const double k = std::sqrt(double(sharing));
    const auto stretch = [&](double& bound, double about) {
        if (about > 0) bound = about * std::pow(bound / about, k);
    };
    ErrorEstimate e = estimate;
    stretch(e.low, e.relmse);
    stretch(e.high, e.relmse);
    stretch(e.rmse_low, e.rmse);
    stretch(e.rmse_high, e.rmse);
    return e;
}

} // namespace blush
