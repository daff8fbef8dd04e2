// RGB image for the metrics: three floats per pixel, top row first.
#pragma once

#include "core/vec.h"

#include <vector>

namespace blush {

struct RgbImage {
    int width = 0, height = 0;
    std::vector<Vec3> pixels; // width * height
};

} // namespace blush
