// Divides an image that is too large for the memory into overlapping tiles.
#pragma once

#include <functional>
#include <optional>

namespace blush::denoise {

struct TileGrid {
    int image_width = 0, image_height = 0;
    int columns = 1, rows = 1;
    int step_x = 0, step_y = 0; // of the parts that the tiles output
    int width = 0, height = 0;  // of each tile's network input, the same for all: a multiple of unet_side_multiple
};

struct Tile {
    int x = 0, y = 0;                             // the first pixel of the network input
    int left = 0, top = 0, right = 0, bottom = 0; // the part of the image that this tile outputs, right and bottom excluded
};

// The smallest number of tiles that fit the memory; nullopt if not even the smallest tile does. Input borders are multiples of
// unet_side_multiple, and further from the output part than the receptive field: so tile seams are invisible.
std::optional<TileGrid> choose_tiles(int image_width, int image_height, const std::function<bool(int width, int height)>& fits);

Tile tile_at(const TileGrid& grid, int column, int row);

} // namespace blush::denoise
