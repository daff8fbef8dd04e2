// Places a grid over the receivers that a pilot has met.
#pragma once

#include "shading/receiver_grid.h"

#include <vector>

namespace blush {

// A grid over these positions but for the outermost in each direction, with so many cells along its longest side. Positions that are not
// finite are ignored. The grid scales exactly with powers of two. cells_per_metre is 0 if there is nothing to cover.
ReceiverGrid make_receiver_grid(const std::vector<Vec3>& positions, int cells_along_longest);

bool is_finite_position(const Vec3& position);

} // namespace blush
