// How an image too large for the memory is cut into tiles that overlap.
#pragma once

#include <functional>
#include <optional>

namespace blush::denoise {

struct TileGrid {
    int image_width = 0, image_height = 0;
    int columns = 1, rows = 1;
    int step_x = 0, step_y = 0; // of the parts that the tiles answer for
    int width = 0, height = 0;  // of what the network sees of each, the same for all: a multiple of unet_side_multiple
};

struct Tile {
    int x = 0, y = 0;                             // the first pixel that the network sees
    int left = 0, top = 0, right = 0, bottom = 0; // the part of the image that this tile answers for, right and bottom excluded
};

// The fewest tiles of which one fits; nullopt if not even the smallest does. All edges between what the network sees are multiples
// of unet_side_multiple, as far from the part answered for as the network reaches: then tiles do not show.
std::optional<TileGrid> choose_tiles(int image_width, int image_height, const std::function<bool(int width, int height)>& fits);

Tile tile_at(const TileGrid& grid, int column, int row);

} // namespace blush::denoise
