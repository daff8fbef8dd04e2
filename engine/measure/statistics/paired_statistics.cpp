#include "measure/statistics/paired_statistics.h"

#include <cmath>

namespace blush {

void Trials::add(double x) {
    ++count_;
    const double before = x - mean_;
    mean_ += before / double(count_);
    squares_ += before * (x - mean_);
}

double Trials::variance() const { return count_ > 1 ? squares_ / double(count_ - 1) : 0; }

double Trials::error() const { return count_ > 0 ? std::sqrt(variance() / double(count_)) : 0; }

} // namespace blush
