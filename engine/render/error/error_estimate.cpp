#include "render/error/error_estimate.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

double square_of(double x) { return x * x; }

constexpr int64_t min_pixels = 64;
constexpr double min_degrees_of_freedom = 20; // degrees of freedom, for normal errors
constexpr double max_interval_ratio = 10;     // ratio high / low of relmse's interval, and of rmse's with small highlights
constexpr double max_missed_share = 0.1;      // of the squared error: moves the RMSE by 5 %, about the half width of its interval
constexpr double max_brightest_share = 0.3;   // of the squared error, for one sample of the brightest pixel
// Bias correction and its standard deviation, as fractions of the logarithm of (relmse with the darkest neighbourhood / relmse
// with the default one).
constexpr double darkest_bias = 0.15, darkest_bias_sigma = 0.25;
// Standard deviation of the logarithm of (relmse / relmse where outliers' pixels are as bright as their other halves), as a fraction of it.
constexpr double brighter_sigma = 0.35;
constexpr double max_brightness = 7;  // of the other halves of outliers, relative to the mean around them
constexpr double outlier_sigma = 0.7; // standard deviation of what each outlier loses by a brighter divisor, relative to its loss
// The half with one sample more has less variance than its share if points are well distributed. One standard deviation of this
// effect, per difference of the halves' weights. At most 1, for points whose variance falls with the square of their number.
constexpr double share_of_inequality = 0.6;

// Half width of the 95 % interval of the logarithm of F with (n, n) degrees of freedom, whose variance is about v = 4 / n: within
// 1 % of tabulated quantiles for n >= 2.
double log_interval(double v) { return 1.96 * std::sqrt(v) * (1 + 0.16 * v); }

// Variance of log(true error / estimate), for small relative variances.
double log_variance(const ErrorSums& all, const ErrorSums::Weighted& sums) {
    const double neighbours = all.pairs > 0 ? sums.neighbour_products * double(all.pixels) / double(all.pairs) : 0;
    const auto [less, more] = std::minmax(neighbours, sums.own_products);
    return (more + less / 2) / square_of(sums.squares);
}

// Logarithm of (relmse / relmse with outliers' pixels as bright as their other halves): the squares are known for `brighter` times the
// divisor's value, and taken to follow a power of it.
double log_brighter_ratio(const ErrorSums& sums) {
    const ErrorSums::Outliers& o = sums.outliers;
    if (!(o.other_half > o.around) || !(o.loss > 0)) return 0;
    const double brightness = std::min(o.other_half / o.around, max_brightness);
    return -std::log1p(-o.loss / sums.relative.squares) / std::log(double(brighter)) * std::log(brightness);
}

// True if enough pixels carry the error for a meaningful interval.
bool has_enough_degrees_of_freedom(const ErrorSums::Weighted& s) {
    return normal_product(1.0) * s.fourths <= 4 / min_degrees_of_freedom * square_of(s.squares);
}

} // namespace

ErrorEstimate estimate_error(const ErrorSums& sums, double sharing) {
    const ErrorSums::Weighted &absolute = sums.absolute, &relative = sums.relative;
    ErrorEstimate e;
    if (sums.pixels < min_pixels) return e;
    e.known = e.rmse_known = true;
    if (absolute.squares == 0) return e; // no noise

    const double values = 3 * double(sums.pixels);
    const double inequality = square_of(share_of_inequality * sums.unequal / absolute.squares);
    // Few pixels at a bright lamp carry most of the squared error, even with more samples of the emission, and their halves may agree by
    // chance. So these only count for relmse, in which a bright pixel is one of many.
    const auto is_seen = [&](double brightest) { return brightest <= max_brightest_share * absolute.squares; };
    const double absolute_width = log_interval(sharing * log_variance(sums, absolute) + inequality);
    e.rmse_known = is_seen(sums.brightest) && has_enough_degrees_of_freedom(absolute);
    e.rmse = std::sqrt(absolute.squares / values);
    e.rmse_low = e.rmse * std::exp(-absolute_width / 2);
    e.rmse_high = e.rmse * std::exp(absolute_width / 2);

    const double choice = std::log(sums.relative_high / relative.squares);
    const double brighter_ratio = log_brighter_ratio(sums);
    const double divisor_variance = square_of(darkest_bias_sigma * choice) + square_of(brighter_sigma * brighter_ratio) +
                                    square_of(outlier_sigma / relative.squares) * sums.outliers.loss_squares;
    const double relative_width = log_interval(sharing * log_variance(sums, relative) + inequality + divisor_variance);
    e.known =
        is_seen(sums.brightest_emission) && has_enough_degrees_of_freedom(relative) && 2 * relative_width <= std::log(max_interval_ratio);
    e.relmse = relative.squares / values * std::exp(darkest_bias * choice - brighter_ratio);
    e.low = e.relmse * std::exp(-relative_width);
    e.high = e.relmse * std::exp(relative_width);
    return e;
}

void include_small_highlights(ErrorEstimate& error, const SmallHighlights& highlights, double samples, int width, int height) {
    const int64_t pixels = int64_t(width) * height;
    const double values = 3 * double(pixels);
    const SmallHighlights::Missed missed = highlights.missed(samples, pixels);
    if (missed.squares > max_missed_share * square_of(error.rmse) * values) {
        error.misses_highlights = true;
        error.rmse_high = std::sqrt(square_of(error.rmse_high) + missed.squares / values);
        error.rmse_known = error.rmse_known && error.rmse_high <= max_interval_ratio * error.rmse_low;
    }
    if (missed.relative > max_missed_share * error.relmse * values) {
        error.misses_highlights = true;
        error.high += missed.relative / values;
        error.known = error.known && error.high <= max_interval_ratio * error.low;
    }
}

} // namespace blush
