#include "measure/statistics/path_statistics.h"

#include "measure/statistics/intervals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace blush {
namespace {

constexpr double bins_per_octave = 2;

int bin_of(double value) { return int(std::floor(std::log2(value) * bins_per_octave)); }

} // namespace

std::vector<RunningMean> running_means(std::span<const double> values) {
    std::vector<RunningMean> means;
    double mean = 0, squares = 0; // Welford 1962
    int64_t next = 1;
    for (size_t i = 0; i < values.size(); ++i) {
        const auto n = int64_t(i) + 1;
        const double off = values[i] - mean;
        mean += off / double(n);
        squares += off * (values[i] - mean);
        if (n < next && i + 1 < values.size()) continue;
        next = std::max(n + 1, n * 11 / 10);
        const double half = n > 1 ? student_95(n - 1) * std::sqrt(squares / double(n - 1) / double(n)) : 0;
        means.push_back({n, mean, mean - half, mean + half});
    }
    return means;
}

double LogHistogram::edge(size_t bin) const { return low * std::exp2(double(bin) / bins_per_octave); }

LogHistogram log_histogram(std::span<const double> values, size_t most) {
    LogHistogram h;
    double smallest = INFINITY, largest = 0;
    for (const double v : values) {
        if (!(v > 0)) {
            ++h.zeros;
            continue;
        }
        smallest = std::min(smallest, v);
        largest = std::max(largest, v);
    }
    if (largest == 0) return h;
    const int last = bin_of(largest), first = std::max(bin_of(smallest), last - int(most) + 1);
    h.low = std::exp2(first / bins_per_octave);
    h.high = std::exp2((last + 1) / bins_per_octave);
    h.counts.assign(size_t(last - first) + 1, 0);
    h.shares.assign(h.counts.size(), 0);
    const double sum = std::accumulate(values.begin(), values.end(), 0.0, [](double s, double v) { return s + std::max(v, 0.0); });
    for (const double v : values) {
        if (!(v > 0)) continue;
        const auto bin = size_t(std::clamp(bin_of(v) - first, 0, last - first));
        ++h.counts[bin];
        h.shares[bin] += v / sum;
    }
    return h;
}

} // namespace blush
