// Cells of a grid without bounds, by hashed keys. Points within half a cell's size of a point are in the eight cells from the first on.
#pragma once

#include "core/math.h"
#include "core/vec.h"

#include <cmath>
#include <cstdint>

namespace blush {

struct CellIndex {
    int64_t x, y, z;
    // Cells that are 2^21 apart share a key.
    uint64_t key() const { return uint64_t(x & 0x1fffff) | uint64_t(y & 0x1fffff) << 21 | uint64_t(z & 0x1fffff) << 42; }
};
inline CellIndex cell_of(const Vec3d& at, double size) {
    return {int64_t(std::floor(at.x / size)), int64_t(std::floor(at.y / size)), int64_t(std::floor(at.z / size))};
}
// Calls visit(key) for the eight cells around a point.
template <class Visit> void for_each_cell_near(const Vec3d& at, double size, const Visit& visit) {
    const CellIndex first = cell_of(at - Vec3d{size, size, size} * 0.5, size);
    for (int corner = 0; corner < 8; ++corner)
        visit(CellIndex{first.x + (corner & 1), first.y + (corner >> 1 & 1), first.z + (corner >> 2)}.key());
}

} // namespace blush
