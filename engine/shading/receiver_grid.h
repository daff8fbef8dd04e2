// A grid of cubic cells over the places where light is received. What pilots learn is stored by its cells.
#pragma once

#include "core/lanes.h"
#include "core/vec.h"

#include <cstdint>

namespace blush {

constexpr int receiver_sides = 6; // two sides of a wall are lit by different lights

struct ReceiverGrid {
    int32_t cells[3] = {1, 1, 1};
    Vec3 low{0, 0, 0}; // corner; receivers outside take the nearest cell
    float cells_per_metre = 0;

    int32_t count() const { return cells[0] * cells[1] * cells[2]; }
    bool operator==(const ReceiverGrid&) const = default;
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

// Index of the receiver's cell, x fastest.
template <class F> Int<F> receiver_cell(const ReceiverGrid& grid, const Vec<F>& position) {
    // The order of min and max maps NaN to cell 0.
    const auto along = [&](const F& x, float low, int32_t cells) {
        return to_int(min(max(F((x - low) * grid.cells_per_metre), F(0.f)), F(float(cells - 1))));
    };
    const Int<F> x = along(position.x, grid.low.x, grid.cells[0]), y = along(position.y, grid.low.y, grid.cells[1]),
                 z = along(position.z, grid.low.z, grid.cells[2]);
    return (z * grid.cells[1] + y) * grid.cells[0] + x;
}

// Side of a surface: the largest component of its normal and the sign of that, 0 .. receiver_sides - 1. A zero normal has a side, too.
template <class F> Int<F> receiver_side(const Vec<F>& normal) {
    const Vec<F> along = abs(normal);
    const Mask<F> is_x = along.x >= along.y && along.x >= along.z, is_y = along.y >= along.z;
    const F component = select(is_x, normal.x, select(is_y, normal.y, normal.z));
    const Int<F> axis = select(is_x, Int<F>(0), select(is_y, Int<F>(2), Int<F>(4)));
    return select(component < F(0.f), Int<F>(axis + 1), axis);
}

} // namespace blush::inline BLUSH_ISA
