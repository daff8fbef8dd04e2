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

    // Every positive weight gets one unit; the rest is distributed by the cumulative sum, which is monotone.
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

std::vector<int32_t> make_guide(std::span<const uint32_t> thresholds, int bits) {
    assert(!thresholds.empty() && bits >= 1 && bits <= 24);
    const size_t count = size_t(1) << bits;
    std::vector<int32_t> guide(count + 1);
    size_t index = 0;
    for (size_t i = 0; i < count; ++i) {
        const uint32_t begin = uint32_t(i) << (32 - bits);
        while (index + 1 < thresholds.size() && thresholds[index + 1] <= begin) ++index;
        guide[i] = int32_t(index);
    }
    guide[count] = int32_t(thresholds.size() - 1);
    return guide;
}

} // namespace blush
