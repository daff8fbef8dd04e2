// Is a rule biased? Two estimators of the same picture, run side by side in rounds with the same random numbers.
#pragma once

#include <cstdint>
#include <vector>

namespace blush {

// Mean and spread of what rounds measured.
class Trials {
public:
    void add(double x);
    int64_t count() const { return count_; }
    double mean() const { return mean_; }
    double variance() const; // of one round; 0 for fewer than two
    double error() const;    // standard error of the mean

private:
    int64_t count_ = 0;
    double mean_ = 0, squares_ = 0; // Welford's recurrence
};

// |t| above which the mean of n normal rounds differs from 0, if `tests` such tests together may be wrong with probability alpha (Sidak).
// Infinite for fewer than two rounds. Student's quantile by the Cornish-Fisher expansion in 1 / (n - 1), good to 1 % from 8 rounds on.
double critical_t(int64_t rounds, int tests, double alpha);

} // namespace blush
