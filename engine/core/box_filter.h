// Box filter for resampling a row of cells to another number of cells.
#pragma once

#include <algorithm>
#include <cstdint>

namespace blush {

// Calls visit(cell, weight) for each of `from` source cells that cell `i` of `to` target cells overlaps; weights sum to 1.
template <class Visit> void for_each_box_weight(int i, int from, int to, const Visit& visit) {
    const int64_t begin = int64_t(i) * from, end = begin + from; // in units of 1 / (from * to)
    for (int64_t j = begin / to; j * to < end; ++j)
        visit(int(j), float(double(std::min(end, (j + 1) * to) - std::max(begin, j * to)) / from));
}

// `size` halved `times` times, at least 1.
inline int halved(int size, int times) { return std::max(1, size >> times); }

} // namespace blush
