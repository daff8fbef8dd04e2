// Radiance that a light path carries to a pixel.
#pragma once

#include "core/vec.h"

#include <cstdint>

namespace blush {

struct Splat {
    int32_t pixel = 0; // y * width + x, inside the film
    Vec3 radiance{0, 0, 0};
    uint16_t scatterings = 0; // of the path, 65535 for more
    uint16_t group = 0;       // of its light; only with light groups
};

} // namespace blush
