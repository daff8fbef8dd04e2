// Plane of values that are stored without loss, one per pixel: double precision sums or integers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace blush {

// Exactly one of the two vectors is used.
struct LosslessPlane {
    std::string name;
    std::vector<double> sums = {};
    std::vector<uint32_t> words = {};
    size_t size() const { return sums.empty() ? words.size() : sums.size(); }
    bool operator==(const LosslessPlane&) const = default;
};

} // namespace blush
