// The beauty split by light group, for the light mix.
#pragma once

#include "core/vec.h"
#include "render/kernels/kernel.h"

#include <cstddef>
#include <span>
#include <vector>

namespace blush {

// Sums in double precision for each half of the film, so that the error of any mix can be computed. The planes of a sample sum to
// its contribution to the beauty, up to rounding of sums in another order.
class GroupPlanes {
public:
    static size_t bytes_per_pixel(int groups) { return 2 * size_t(groups) * sizeof(Vec3d); }

    size_t memory_bytes() const { return sums_.capacity() * sizeof(Vec3d); }
    // Clears the planes; 0 groups: none.
    void reset(size_t pixels, int groups);
    int groups() const { return groups_; }
    // Adds one sample, a slot of the tile; light after `first_scaled`
    // (0 or 2) or more scatterings is multiplied by `scale` (clamping).
    void add(size_t pixel, int half, const TileScratch& tile, int slot, int first_scaled, double scale);

    Vec3d& sum(size_t pixel, int half, size_t group) { return sums_[place(pixel, half) + group]; }
    const Vec3d& sum(size_t pixel, int half, size_t group) const { return sums_[place(pixel, half) + group]; }
    // Sum over all groups, each times its gain.
    Vec3d mixed(size_t pixel, int half, std::span<const Vec3> gains) const;

private:
    size_t place(size_t pixel, int half) const { return (2 * pixel + size_t(half)) * size_t(groups_); }

    int groups_ = 0;
    std::vector<Vec3d> sums_; // the groups of one half of a pixel are adjacent
};

} // namespace blush
