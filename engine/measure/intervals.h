// Means, slopes and quantiles with the 95 % intervals that a few measurements allow.
#pragma once

#include <cstdint>
#include <span>

namespace blush {

// A value with its 95 % interval; not known if there was too little to tell from.
struct Interval {
    bool known = false;
    double value = 0, low = 0, high = 0;
};

// Probability that a standard normal is beyond +-z; and the z beyond which p lies.
double normal_two_sided(double z);
double normal_quantile_two_sided(double p);

// What 95 % of Student's t with `degrees` degrees of freedom stay within; exact up to 3, elsewhere within half a percent of tables
// (Hill 1970, the expansion in 1 / degrees).
double student_95(int64_t degrees);

// Of the mean of independent values. One value is known, but its interval is not: low = high = value, and known is false.
Interval mean_interval(std::span<const double> values);

// Slope of log y over log x, all positive, by least squares: -0.5 for RMSE over samples that are independent. `at_one` is y at x = 1.
struct PowerFit {
    Interval slope;
    double at_one = 0;
};
// Fewer than 3 points, or all at one x: not known. The interval takes the points' scatter about the line as independent.
PowerFit fit_power(std::span<const double> x, std::span<const double> y);

// The same where y are errors of running means, over the first samples[i] of one series of samples, ascending. They are not independent:
// those at n and m > n have n / m of their squared error in common, and so correlate like it; the fit and its interval allow for that
// (Prais and Winsten 1954, for neighbours unevenly apart).
PowerFit fit_running(std::span<const double> x, std::span<const double> y, std::span<const double> samples);

// Where the fitted curve reaches y; 0 if it never does.
double reach(const PowerFit& fit, double y);

} // namespace blush
