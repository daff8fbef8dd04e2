// Statistics of the contributions of a pixel's paths: how their mean settles, and how they are distributed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

// The mean of the first `samples` values with its 95 % confidence interval, as of independent values. Stratified samples, as those of
// Sobol points, are at least as good, so the interval is rather too wide for them.
struct RunningMean {
    int64_t samples = 0;
    double mean = 0, low = 0, high = 0; // low = high = mean while nothing is known of the variance
    double half() const { return (high - low) / 2; }
};
// After 1, 2, 3, ... samples, then at numbers that grow by about a tenth, and at the end.
std::vector<RunningMean> running_means(std::span<const double> values);

// Counts of values in bins of equal ratio, for contributions that span decades.
struct LogHistogram {
    int64_t zeros = 0;                // values that are 0 or negative
    double low = 0, high = 0;         // edges of the first and of the last bin; both 0 without positive values
    std::vector<int64_t> counts = {}; // by bin, ascending
    std::vector<double> shares = {};  // of the sum of all values, by bin
    double edge(size_t bin) const;    // lower edge of a bin
};
// Two bins for each factor of two, at most `most` bins: smaller values are in the first one.
LogHistogram log_histogram(std::span<const double> values, size_t most);

} // namespace blush
