// Paired comparison of two estimators of the same image, run in rounds with common random numbers: mean and variance.
#pragma once

#include <cstdint>

namespace blush {

// Mean and variance over the rounds.
class Trials {
public:
    void add(double x);
    int64_t count() const { return count_; }
    double mean() const { return mean_; }
    double variance() const; // of one round; 0 for fewer than two
    double error() const;    // standard error of the mean

private:
    int64_t count_ = 0;
    double mean_ = 0, squares_ = 0; // Welford's algorithm
};

} // namespace blush
