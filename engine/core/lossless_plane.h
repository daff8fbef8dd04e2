// Plane of values that are stored without loss, one per pixel: sums or integers.
#pragma once

#include "core/exact_sum.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace blush {

// Either sums or words are used.
struct LosslessPlane {
    std::string name;
    std::vector<double> sums = {};
    std::vector<uint32_t> words = {};
    std::vector<double> low = {}; // biased low bins of exact sums (exact_sum.h), whose high bins are the sums; else empty
    // A sum, rounded once.
    double sum(size_t pixel) const { return low.empty() ? sums[pixel] : ExactSum::of(sums[pixel], low[pixel]).value(); }
    size_t size() const { return sums.empty() ? words.size() : sums.size(); }
    bool operator==(const LosslessPlane&) const = default;
};

} // namespace blush
