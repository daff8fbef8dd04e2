// The learned adjoint, for Russian roulette that knows what a path is worth: the light that paths find behind a place in the scene, and
// the luminance of the image's pixels. Vorba and Krivanek 2016, "Adjoint-Driven Russian Roulette and Splitting in Light Transport
// Simulation"; Rath et al. 2022, "EARS: Efficiency-Aware Russian Roulette and Splitting".
#pragma once

#include "core/math.h"
#include "shading/receiver_grid.h"

#include <cstdint>

namespace blush {

struct AdjointTables {
    const float* values = nullptr; // by cell, x fastest, and side of the surface; null: nothing has been learned
    ReceiverGrid grid;
    const float* importances = nullptr;     // of pixels, row by row: the inverse of their luminance, 1/nits
    const float* splits = nullptr;          // as `values`, by the side of the direction back along the path; null: no path is split
    int32_t across = 0, down = 0;           // pixels of that table,
    float across_scale = 0, down_scale = 0; // and their number for each pixel of the film

    bool empty() const { return !values; }
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

// What a path behind this vertex is worth, times its throughput and the importance of its pixel: the survival probability before limits.
template <class F> F adjoint_value(const AdjointTables& adjoint, const Vec<F>& position, const Vec<F>& normal) {
    return gather(adjoint.values, Int<F>(receiver_cell<F>(adjoint.grid, position) * receiver_sides + receiver_side<F>(normal)));
}

// The same for a path that arrives at this place, with the direction `wo` back along it: the number of copies before limits.
template <class F> F adjoint_split(const AdjointTables& adjoint, const Vec<F>& position, const Vec<F>& wo) {
    return gather(adjoint.splits, Int<F>(receiver_cell<F>(adjoint.grid, position) * receiver_sides + receiver_side<F>(wo)));
}

// Of the pixel of the film in this column and row.
template <class F> F pixel_importance(const AdjointTables& adjoint, const F& x, const F& y) {
    const auto along = [](const F& at, float scale, int32_t count) { return to_int(min(F((at + 0.5f) * scale), F(float(count - 1)))); };
    const Int<F> column = along(x, adjoint.across_scale, adjoint.across), row = along(y, adjoint.down_scale, adjoint.down);
    return gather(adjoint.importances, Int<F>(row * adjoint.across + column));
}

} // namespace blush::inline BLUSH_ISA
