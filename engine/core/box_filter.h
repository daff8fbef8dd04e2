// One row of cells as another number of cells over the same length: what a box filter makes an image smaller by.
#pragma once

#include <algorithm>
#include <cstdint>

namespace blush {

// Of `from` cells, those that cell `i` of `to` lies on: visit(cell, share of cell i), shares summing up to 1.
template <class Visit> void for_each_overlap(int i, int from, int to, const Visit& visit) {
    const int64_t begin = int64_t(i) * from, end = begin + from; // in units of 1 / (from * to)
    for (int64_t j = begin / to; j * to < end; ++j)
        visit(int(j), float(double(std::min(end, (j + 1) * to) - std::max(begin, j * to)) / from));
}

// Half as many cells as often as told, at least one.
inline int halved(int size, int times) { return std::max(1, size >> times); }

} // namespace blush
