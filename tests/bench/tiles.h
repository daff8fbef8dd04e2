// Tiles for cases that drive kernels themselves.
#pragma once

#include "render/kernels/kernel.h"
#include "scene/render_settings.h"

#include <vector>

namespace blush::bench {

// Every `stride`-th of the tiles that a renderer makes of eight samples of the image, which cuts it into squares of 16 pixels. A stride
// without common factors with the number of tiles in a row takes them from all over the image.
inline std::vector<TileJob> tiles_of(const RenderSettings& settings, int stride) {
    constexpr int side = 16;
    std::vector<TileJob> tiles;
    int index = 0;
    for (int y = 0; y + side <= settings.height; y += side)
        for (int x = 0; x + side <= settings.width; x += side)
            if (index++ % stride == 0) tiles.push_back({.x = x, .y = y, .width = side, .height = side, .first_sample = 0, .samples = 8});
    return tiles;
}

} // namespace blush::bench
