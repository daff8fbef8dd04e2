#include "measure/paired_trials.h"

#include "measure/intervals.h"

#include <cmath>
#include <limits>

namespace blush {
void Trials::add(double x) {
    ++count_;
    const double before = x - mean_;
    mean_ += before / double(count_);
    squares_ += before * (x - mean_);
}

double Trials::variance() const { return count_ > 1 ? squares_ / double(count_ - 1) : 0; }

double Trials::error() const { return count_ > 0 ? std::sqrt(variance() / double(count_)) : 0; }

double critical_t(int64_t rounds, int tests, double alpha) {
    if (rounds < 2) return std::numeric_limits<double>::infinity();
    const double each = -std::expm1(std::log1p(-alpha) / double(tests));
    const double z = normal_quantile_two_sided(each), z3 = z * z * z, z5 = z3 * z * z, n = double(rounds - 1);
    return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) +
           (3 * z5 * z * z + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n);
}

} // namespace blush
