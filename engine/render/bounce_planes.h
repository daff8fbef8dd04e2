// The beauty taken apart by the number of scattering events behind each contribution, as --max-bounces counts them: plane 0 holds what
// glows in view, 1 direct light, 2 the first colour bleeding, ..., the last one everything from there on.
#pragma once

#include "core/vec.h"
#include "render/kernels/kernel.h"

#include <cstddef>
#include <vector>

namespace blush {

// Sums in double precision. What a plane gets of a sample is the difference of what the path had gathered after k and after k - 1 scatterings,
// so that the planes of a sample sum to exactly what the beauty gets of it, the kernel's rounding included.
class BouncePlanes {
public:
    static size_t bytes_per_pixel(int planes) { return size_t(planes) * sizeof(Vec3d); }

    // Cleared planes for so many pixels; 0 planes: none.
    void reset(size_t pixels, int planes);
    // Columns that the kernels must fill for that: all but the last plane's, which is the final radiance.
    int columns() const { return planes_ > 0 ? planes_ - 1 : 0; }
    // One sample: a tile's slot.
    void add(size_t pixel, const TileScratch& tile, int slot);
    // A pixel's sums times `scale` to its place in each plane.
    void resolve(size_t pixel, double scale, std::vector<std::vector<Vec3>>& planes) const;

private:
    int planes_ = 0;
    std::vector<Vec3d> sums_; // the planes of one pixel side by side
};

} // namespace blush
