// Pilot variance for adaptive sampling: the noise of the film's tiles during the pilot, separately for each half of the film.
#pragma once

#include "core/vec.h"
#include "render/film/film.h"
#include "render/film/sample_allocation.h"

#include <array>
#include <utility>
#include <vector>

namespace blush {

// A pixel's noise is the difference of its means over the first and second part of the pilot, which excludes variance removed by
// stratification. Its square is divided as in relmse, so that samples are allocated by the reported error. A smaller divisor
// gives too few samples to dark regions, whose relative error grows more than bright regions gain. One pixel's weight is limited,
// because a firefly makes its pixel bright. A tile's noise is the root mean square over its pixels, smoothed over neighbouring
// tiles, because fireflies can occur there too. With light paths, call both when the film holds as many passes as samples: the sum
// of a half then holds its splats unscaled, and the difference is that of the two parts also for them.
class PilotVariance {
public:
    // Call when the film holds half of the pilot: stores its sums.
    void mark(const Film& film);
    // Call when it holds the whole pilot: returns the noise of the tiles for each half and drops the sums.
    std::array<TileNoise, 2> measure(const Film& film);

    // The stored sums, both halves of each pixel adjacent, for transfer to another object; empty if none.
    const std::vector<Vec3d>& marked() const { return marked_; }
    void restore(std::vector<Vec3d> marked) { marked_ = std::move(marked); }

private:
    double of_pixel(const Film& film, size_t pixel, int half) const;

    std::vector<Vec3d> marked_; // sums of both halves of each pixel
};

} // namespace blush
