// The part of the image that pilots render: small tiles, spread over the film.
#pragma once

#include "core/parallel.h"
#include "render/kernels/kernel.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace blush {

constexpr int pilot_tile_side = 8; // small, so that there are many; a whole block of path reuse groups
constexpr int pilot_samples = 8;   // of each pixel, both halves together
// Of pilots that change how light is sampled, whatever the image's limit: so light by bounces (bounce_planes.h) stays that of shorter
// paths.
constexpr int pilot_max_bounces = 8;

// The whole image at a low resolution, with the same view.
struct PilotImage {
    int width, height;
    std::vector<TileJob> tiles; // of 16 x 16 pixels, with `samples` samples each
};
// Of at most about so many pixels. Reads the size of the image from `settings`.
PilotImage pilot_image(const EstimatorSettings& settings, int pixels, int samples = pilot_samples);

// At most 64 tiles for a film of this size, spread by the R2 sequence (Roberts 2018), whatever its aspect ratio.
std::vector<TileJob> pilot_tiles(int width, int height);

// What the tiles of a pilot run on. `scratch`: one per worker, allocated if needed.
struct TileRunner {
    const Workers& workers;
    std::vector<std::unique_ptr<TileScratch>>& scratch;
    const std::function<bool()>& wanted;

    // Calls task(tile number, scratch) for each tile; false if `wanted` returned false.
    template <class Task> bool for_each(size_t tiles, const Task& task) const {
        return workers.for_each(int64_t(tiles), wanted, [&](int64_t i, unsigned worker) {
            if (!scratch[worker]) scratch[worker] = std::make_unique<TileScratch>();
            task(size_t(i), *scratch[worker]);
        });
    }
};

} // namespace blush
