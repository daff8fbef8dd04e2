#include "render/error_estimate.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr int64_t fewest_pixels = 64;
constexpr double fewest_degrees = 20;   // of freedom, by normal errors
constexpr double widest = 10;           // of relmse's interval: high over low
constexpr double brightest_share = 0.3; // of the squared error, that one sample of the brightest pixel may be
// Of the logarithm of relmse with the darkest surroundings over that with the usual ones: how far the truth is on average, and one standard
// deviation of that.
constexpr double way_to_darkest = 0.15, share_of_choice = 0.25;
// The half with one sample more has less variance than its share if points are well distributed; one standard deviation of what that is
// worth, per difference of the halves' weights. At most 1 for points whose variance falls with the square of their number.
constexpr double share_of_inequality = 0.6;

// Half width of a 95 % interval of the logarithm of F with n degrees of freedom twice, whose variance is about v = 4 / n: within 1 % for n
// >= 2 of tabulated quantiles.
double log_interval(double v) { return 1.96 * std::sqrt(v) * (1 + 0.16 * v); }

double squared(double x) { return x * x; }

// Of the logarithm of true error over estimate, relative variances being small.
double log_variance(const ErrorSums& all, const ErrorSums::Weighted& sums) {
    const double neighbours = all.pairs > 0 ? sums.neighbour_products * double(all.pixels) / double(all.pairs) : 0;
    const auto [less, more] = std::minmax(neighbours, sums.own_products);
    return (more + less / 2) / squared(sums.squares);
}

// Few pixels tell nothing of how large their sum may be.
bool carried_by_many(const ErrorSums::Weighted& s) { return normal_product(1.0) * s.fourths <= 4 / fewest_degrees * squared(s.squares); }

} // namespace

ErrorEstimate estimate_error(const ErrorSums& sums, double sharing) {
    const ErrorSums::Weighted &absolute = sums.absolute, &relative = sums.relative;
    ErrorEstimate e;
    if (sums.pixels < fewest_pixels) return e;
    e.known = e.rmse_known = true;
    if (absolute.squares == 0) return e; // no noise at all

    const double values = 3 * double(sums.pixels);
    const double inequality = squared(share_of_inequality * sums.unequal / absolute.squares);
    const bool brightest_seen = sums.brightest <= brightest_share * absolute.squares;
    const double absolute_width = log_interval(sharing * log_variance(sums, absolute) + inequality);
    e.rmse_known = brightest_seen && carried_by_many(absolute);
    e.rmse = std::sqrt(absolute.squares / values);
    e.rmse_low = e.rmse * std::exp(-absolute_width / 2);
    e.rmse_high = e.rmse * std::exp(absolute_width / 2);

    const double choice = std::log(sums.relative_high / relative.squares);
    const double relative_width = log_interval(sharing * log_variance(sums, relative) + inequality + squared(share_of_choice * choice));
    e.known = brightest_seen && carried_by_many(relative) && 2 * relative_width <= std::log(widest);
    e.relmse = relative.squares / values * std::exp(way_to_darkest * choice);
    e.low = e.relmse * std::exp(-relative_width);
    e.high = e.relmse * std::exp(relative_width);
    return e;
}

} // namespace blush
