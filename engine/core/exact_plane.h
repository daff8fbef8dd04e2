// Numbers that must survive to the last bit, one for each pixel: sums in double precision, or whole numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace blush {

// One of the two vectors is filled.
struct ExactPlane {
    std::string name;
    std::vector<double> sums = {};
    std::vector<uint32_t> words = {};
    size_t size() const { return sums.empty() ? words.size() : sums.size(); }
    bool operator==(const ExactPlane&) const = default;
};

} // namespace blush
