// Places a grid over the receivers that a pilot has met.
#pragma once

#include "shading/receiver_grid.h"

#include <vector>

namespace blush {

// A grid over these positions but for the outermost in each direction, with so many cells along its longest side. Positions that are not
// finite are ignored. The grid scales exactly with powers of two. cells_per_metre is 0 if there is nothing to cover.
ReceiverGrid make_receiver_grid(const std::vector<Vec3>& positions, int cells_along_longest);

bool is_finite_position(const Vec3& position);

// The cells of a grid in cubic blocks of `side` cells: where a cell has learned little, its block says more.
struct CellBlocks {
    const ReceiverGrid& grid;
    int32_t side;

    int32_t along(int axis) const { return (grid.cells[axis] + side - 1) / side; }
    int32_t count() const { return along(0) * along(1) * along(2); }
    int32_t of(int32_t cell) const {
        const int32_t x = cell % grid.cells[0], y = cell / grid.cells[0] % grid.cells[1], z = cell / (grid.cells[0] * grid.cells[1]);
        return (z / side * along(1) + y / side) * along(0) + x / side;
    }
};

} // namespace blush
