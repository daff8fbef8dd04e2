// Two estimators of the same picture, run side by side in rounds with the same random numbers: how their differences scatter.
#pragma once

#include <cstdint>

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

} // namespace blush
