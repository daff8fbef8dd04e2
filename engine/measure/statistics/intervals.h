// Means, slopes and quantiles with 95 % confidence intervals.
#pragma once

#include <cstdint>
#include <span>

namespace blush {

// A value with its 95 % confidence interval; `known` is false if there are too few data.
struct Interval {
    bool known = false;
    double value = 0, low = 0, high = 0;
};

// Two-sided p-value of a standard normal deviate z, and its inverse.
double normal_two_sided(double z);
double normal_quantile_two_sided(double p);

// Two-sided 95 % quantile of Student's t with `degrees` degrees of freedom; exact up to 3, else within 0.5 % (Hill 1970,
// expansion in 1 / degrees).
double student_95(int64_t degrees);

// Confidence interval of the mean of independent values. For a single value: low = high = value, known is false.
Interval mean_interval(std::span<const double> values);

// Slope of log y over log x, all positive, by least squares: -0.5 for RMSE over samples that are independent. `at_one` is y at x = 1.
struct PowerFit {
    Interval slope;
    double at_one = 0;
};
// Unknown for fewer than 3 points or a single x. The interval assumes independent residuals.
PowerFit fit_power(std::span<const double> x, std::span<const double> y);

// The same for errors y of running means over the first samples[i] of one series of samples, ascending. They are correlated:
// those at n and m > n share n / m of their squared error. Generalised least squares accounts for it (Prais and Winsten 1954, for
// uneven spacing).
PowerFit fit_running(std::span<const double> x, std::span<const double> y, std::span<const double> samples);

// x at which the fitted curve reaches y; 0 if it never does.
double reach(const PowerFit& fit, double y);

} // namespace blush
