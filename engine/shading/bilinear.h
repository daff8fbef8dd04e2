// Bilinear interpolation in tables of two parameters.
#pragma once

#include "core/math.h"

namespace blush::inline BLUSH_ISA {

// Interpolates the size x size `table`, row-major, at (row, column), each in [0, size - 1]; size >= 2.
template <class F> F bilinear(const float* table, int size, const F& row, const F& column) {
    const float last = float(size - 1);
    const F row0 = min(floor(row), F(last - 1.f)), column0 = min(floor(column), F(last - 1.f));
    const Int<F> at = to_int(row0) * size + to_int(column0);
    const F t = column - column0;
    const F low = lerp(gather(table, at), gather(table + 1, at), t);
    const F high = lerp(gather(table + size, at), gather(table + size + 1, at), t);
    return lerp(low, high, F(row - row0));
}

} // namespace blush::inline BLUSH_ISA
