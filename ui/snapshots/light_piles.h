// The two piles of light of a pixel, from the bounce planes.
#pragma once

#include "render/frame.h"

namespace blush {

// Direct light, which is seen directly or scattered once, and all other light. Their sum is the pixel, up to the rounding of single
// precision.
struct TwoPiles {
    Vec3 direct{0, 0, 0}, indirect{0, 0, 0};
};
// Of a frame with bounce planes.
TwoPiles piles_of(const Frame& frame, size_t pixel);

} // namespace blush
