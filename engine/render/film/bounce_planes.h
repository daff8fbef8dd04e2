// Splits the beauty by the number of scattering events, as --max-bounces counts them: plane 0 holds directly visible emission, 1
// direct light, 2 the first indirect bounce, ..., the last one all further bounces.
#pragma once

#include "core/exact_sum.h"
#include "render/kernels/kernel.h"

#include <cstddef>
#include <vector>

namespace blush {

// Exact sums. A sample's contribution to plane k is the difference of its radiance after k and k - 1 scatterings,
// so the planes of a sample sum to exactly its contribution to the beauty, including the kernel's rounding.
class BouncePlanes {
public:
    static size_t bytes_per_pixel(int planes) { return size_t(planes) * sizeof(ExactSum3); }

    size_t memory_bytes() const { return sums_.capacity() * sizeof(ExactSum3); }

    // Clears the planes. `places`: one or two per pixel. 0 planes: none.
    void reset(size_t places, int planes);
    // Columns that the kernels must fill: all but the last plane's, which is the final radiance.
    int columns() const { return planes_ > 0 ? planes_ - 1 : 0; }
    // Adds one sample, a slot of the tile. Light after `first_scaled` or more scatterings is multiplied by `scale` (clamping).
    void add(size_t place, const TileScratch& tile, int slot, int first_scaled, double scale);
    int planes() const { return planes_; }
    ExactSum3& sum(size_t place, size_t plane) { return sums_[place * size_t(planes_) + plane]; }
    const ExactSum3& sum(size_t place, size_t plane) const { return sums_[place * size_t(planes_) + plane]; }

private:
    int planes_ = 0;
    std::vector<ExactSum3> sums_; // the planes of one place are adjacent
};

} // namespace blush
