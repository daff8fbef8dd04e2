#include "render/denoise/tiles.h"

#include "render/denoise/unet_layers.h"

#include <algorithm>

namespace blush::denoise {
namespace {

int round_up(int x) { return (x + unet_side_multiple - 1) / unet_side_multiple * unet_side_multiple; }

// One axis of a grid: `count` parts of a side.
struct Cut {
    int count, step, seen;
};
Cut cut(int side, int count) {
    const int step = round_up((side + count - 1) / count);
    return {(side + step - 1) / step, step, std::min(round_up(side), count == 1 ? step : step + 2 * unet_reach)};
}

int first_seen(int side, int index, int step, int seen) { return std::clamp(index * step - unet_reach, 0, round_up(side) - seen); }

} // namespace

std::optional<TileGrid> choose_tiles(int image_width, int image_height, const std::function<bool(int width, int height)>& fits) {
    for (int columns = 1, rows = 1;;) {
        const Cut x = cut(image_width, columns), y = cut(image_height, rows);
        if (fits(x.seen, y.seen)) return TileGrid{image_width, image_height, x.count, y.count, x.step, y.step, x.seen, y.seen};
        if (x.step <= unet_side_multiple && y.step <= unet_side_multiple) return std::nullopt;
        (x.seen >= y.seen ? columns : rows)++;
    }
}

Tile tile_at(const TileGrid& grid, int column, int row) {
    Tile tile;
    tile.x = first_seen(grid.image_width, column, grid.step_x, grid.width);
    tile.y = first_seen(grid.image_height, row, grid.step_y, grid.height);
    tile.left = column * grid.step_x;
    tile.top = row * grid.step_y;
    tile.right = std::min(tile.left + grid.step_x, grid.image_width);
    tile.bottom = std::min(tile.top + grid.step_y, grid.image_height);
    return tile;
}

} // namespace blush::denoise
