// What adaptive sampling goes by: the noise of the film's tiles during the pilot, each half of the film by itself.
#pragma once

#include "core/vec.h"
#include "render/film.h"
#include "render/sample_plan.h"

#include <array>
#include <utility>
#include <vector>

namespace blush {

// The noise of a pixel is judged by how much its mean over the first part of the pilot differs from that over the second, so that what the
// sampler's stratification takes away does not count. Its square is divided as relmse divides: the error that is reported is the one that
// samples are spent on. Divided by less, dark parts of a picture get too few samples, and their relative error grows by more than bright
// parts gain. A firefly makes its pixel bright too, so one pixel never counts for more than a few. A tile's noise is the root of the mean
// over its pixels, smoothed over the tiles around, for what made a firefly here can make one there.
class PilotNoise {
public:
    // When the film holds half of the pilot: remembers its sums.
    void mark(const Film& film);
    // When it holds all of the pilot; forgets the sums. For each half, the noise of its tiles.
    std::array<TileNoise, 2> measure(const Film& film);

    // The sums that it remembers, both halves of each pixel side by side, to be given to another one; empty if none.
    const std::vector<Vec3d>& marked() const { return marked_; }
    void restore(std::vector<Vec3d> marked) { marked_ = std::move(marked); }

private:
    double of_pixel(const Film& film, size_t pixel, int half) const;

    std::vector<Vec3d> marked_; // sums of both halves of each pixel
};

} // namespace blush
