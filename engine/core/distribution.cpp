#include "core/distribution.h"

#include <algorithm>
#include <cassert>

namespace blush {

std::vector<uint32_t> make_thresholds(std::span<const double> weights) {
    const size_t n = weights.size();
    assert(n > 0 && n <= size_t(1) << 24);
    double total = 0;
    for (const double w : weights) total += w;
    const bool uniform = !(total > 0);

    // First give every positive weight one unit, then share out the rest by the running sum, which is monotone.
    size_t positive = 0;
    for (const double w : weights) positive += uniform || w > 0;
    const double share = 0x1p32 - double(positive);
    std::vector<uint32_t> thresholds(n);
    double sum = 0;
    uint64_t units = 0;
    for (size_t i = 0; i < n; ++i) {
        const uint64_t low = units + uint64_t(share * std::min(1.0, uniform ? double(i) / double(n) : sum / total));
        thresholds[i] = uint32_t(std::min<uint64_t>(low, 0xffffffffu));
        sum += weights[i];
        units += uniform || weights[i] > 0;
    }
    return thresholds;
}

} // namespace blush
