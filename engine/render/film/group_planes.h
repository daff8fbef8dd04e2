// The beauty split by light group, for the light mix, or by strategy.
#pragma once

#include "core/exact_sum.h"
#include "render/kernels/group_columns.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace blush {

// Exact sums for each half of the film, so that the error of any mix can be computed. The planes of a sample sum to
// its contribution to the beauty, up to rounding of sums in another order.
class GroupPlanes {
public:
    static size_t bytes_per_pixel(int groups) { return 2 * size_t(groups) * sizeof(ExactSum3); }

    size_t memory_bytes() const { return sums_.capacity() * sizeof(ExactSum3); }
    // Clears the planes; 0 groups: none.
    void reset(size_t pixels, int groups);
    int groups() const { return groups_; }
    // Adds one sample, a slot of the tile whose columns these are; light after `first_scaled`
    // (0 or 2) or more scatterings is multiplied by `scale` (clamping). All light of planes `first_indirect` and
    // above has scattered so often: manifold sampling and light vertices find it before the direct light is complete.
    void add(size_t pixel, int half, const GroupColumns& columns, int slot, int first_scaled, double scale,
             int first_indirect = std::numeric_limits<int>::max());

    ExactSum3& sum(size_t pixel, int half, size_t group) { return sums_[place(pixel, half) + group]; }
    const ExactSum3& sum(size_t pixel, int half, size_t group) const { return sums_[place(pixel, half) + group]; }

private:
    size_t place(size_t pixel, int half) const { return (2 * pixel + size_t(half)) * size_t(groups_); }

    int groups_ = 0;
    std::vector<ExactSum3> sums_; // the groups of one half of a pixel are adjacent
};

} // namespace blush
