// Numerical weak points of renderers, which the cases of the battery test.
#pragma once

#include <span>
#include <string_view>

namespace blush::stability {

struct HotSpot {
    int number;
    std::string_view name;
    std::string_view remedy; // the remedy used here, with its source
};

std::span<const HotSpot> hot_spots();
// By number; empty for 0.
const HotSpot& hot_spot(int number);

} // namespace blush::stability
