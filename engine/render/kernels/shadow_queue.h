// Shadow rays of a tile, with the light that they bring.
#pragma once

#include "render/kernels/column.h"

#include <cstdint>

namespace blush {

struct ShadowQueue {
    int size = 0;
    Column<float> ox, oy, oz, dx, dy, dz, distance, r, g, b;
    Column<int32_t> slot;
    Column<uint32_t> random; // for blended surfaces; written only if there are some
    Column<int32_t> group;   // light group; written only with a light mix
    Column<uint32_t> mask;   // ray mask; written only if lights are linked
    Column<int32_t> trial;   // index of TileScratch::trials; written only if they are recorded
};

} // namespace blush
