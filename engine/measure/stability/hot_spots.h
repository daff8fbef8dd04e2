// Where renderers lose their numbers: what every case of the battery stands guard over.
#pragma once

#include <span>
#include <string_view>

namespace blush::stability {

struct HotSpot {
    int number;
    std::string_view name;
    std::string_view remedy; // what guards it here, and whose idea that is
};

std::span<const HotSpot> hot_spots();
// By number; the empty one for 0.
const HotSpot& hot_spot(int number);

} // namespace blush::stability
