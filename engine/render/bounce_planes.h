// The beauty taken apart by the number of scattering events behind each contribution, as --max-bounces counts them: plane 0 holds what
// glows in view, 1 direct light, 2 the first colour bleeding, ..., the last one everything from there on.
#pragma once

#include "core/vec.h"
#include "render/kernels/kernel.h"

#include <cstddef>
#include <vector>

namespace blush {

// Sums in double precision. What a plane gets of a sample is the difference of what the path had gathered after k and after k - 1
// scatterings, so that the planes of a sample sum to exactly what the beauty gets of it, the kernel's rounding included.
class BouncePlanes {
public:
    static size_t bytes_per_pixel(int planes) { return size_t(planes) * sizeof(Vec3d); }

    size_t memory_bytes() const { return sums_.capacity() * sizeof(Vec3d); }

    // Cleared planes with so many places, one or two for each pixel; 0 planes: none.
    void reset(size_t places, int planes);
    // Columns that the kernels must fill for that: all but the last plane's, which is the final radiance.
    int columns() const { return planes_ > 0 ? planes_ - 1 : 0; }
    // One sample: a tile's slot; light of `first_scaled` scatterings and more times `scale`, which is what clamping does.
    void add(size_t place, const TileScratch& tile, int slot, int first_scaled, double scale);
    int planes() const { return planes_; }
    Vec3d& sum(size_t place, size_t plane) { return sums_[place * size_t(planes_) + plane]; }
    const Vec3d& sum(size_t place, size_t plane) const { return sums_[place * size_t(planes_) + plane]; }

private:
    int planes_ = 0;
    std::vector<Vec3d> sums_; // the planes of one place side by side
};

} // namespace blush
