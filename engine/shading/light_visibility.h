// Learned visibility: how often the shadow rays from a region of the scene reach each child of the light tree's root and each distant
// light. A grid over the receivers holds it, with a row for each cell and each of six sides of a surface: two sides of a wall are lit
// by different lights. Related: Guo et al. 2020, "Next Event Estimation++: Visibility Mapping for Efficient Light Transport Simulation".
#pragma once

#include "core/math.h"
#include "shading/receiver_grid.h"

#include <cstdint>

namespace blush {

// The share of samples that are distributed without learned visibility (defensive mixture, Hesterberg 1995): so no receiver has more than
// the inverse of it times the variance that it has without.
constexpr float unlearned_share = 1.f / 16;
constexpr int visibility_word_lights = 4; // factors in a word, one byte each, at least 1
constexpr int max_visibility_lights = 32;

struct LightVisibilityGrid {
    const uint32_t* factors = nullptr; // rows of `words`: by cell, x fastest, and side; null: nothing has been learned
    int32_t words = 0;                 // of a row: child k of the root has byte k, distant light k byte root_count + k
    ReceiverGrid grid;

    bool operator==(const LightVisibilityGrid&) const = default;
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

// First word of the receiver's row.
template <class F> Int<F> visibility_row(const LightVisibilityGrid& visibility, const Vec<F>& position, const Vec<F>& normal) {
    return (receiver_cell<F>(visibility.grid, position) * receiver_sides + receiver_side<F>(normal)) * visibility.words;
}

// Multiplies the importances of[0..count) by the factors of the receiver's row, and mixes them with the importances as they were.
template <class F>
void apply_visibility(const LightVisibilityGrid& visibility, const Vec<F>& position, const Vec<F>& normal, F* of, int count) {
    const Int<F> row = visibility_row<F>(visibility, position, normal);
    F factors[max_visibility_lights], unlearned = F(0.f), learned = F(0.f);
    for (int word = 0; word * visibility_word_lights < count; ++word) {
        const UInt<F> four = gather(visibility.factors + word, row);
        for (int k = 0; k < visibility_word_lights && word * visibility_word_lights + k < count; ++k) {
            const int light = word * visibility_word_lights + k;
            factors[light] = to_float(to_signed(UInt<F>((four >> (8 * k)) & 255u))) * (1.f / 255);
            unlearned = unlearned + of[light];
            learned = learned + of[light] * factors[light];
        }
    }
    const F share = (1.f - unlearned_share) * unlearned / select(learned > F(0.f), learned, F(1.f));
    for (int light = 0; light < count; ++light) of[light] = of[light] * (factors[light] * share + unlearned_share);
}

} // namespace blush::inline BLUSH_ISA
