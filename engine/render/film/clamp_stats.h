// Clamping of samples, with exact statistics of the removed light.
#pragma once

#include "core/exact_sum.h"
#include "render/diagnostics/health.h"
#include "render/kernels/kernel.h"
#include "scene/render_settings.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace blush {

// Limits a sample's largest component to `limit` and keeps its hue.
// Applies to all light, or only to light scattered more than once.
class ClampStats {
public:
    // Statistics for each place; one or two places per pixel.
    void reset(size_t places, const Clamp& clamp);
    bool on() const { return clamp_.limit > 0; }
    // Columns that the kernels must fill for this.
    int columns() const { return on() && !clamp_.all ? 2 : 0; }
    // Samples whose components sum to less than this are never clamped.
    float min_clamped_sum() const;

    // Clamps a valid sample in a slot of the tile. `first_scaled` and `scale`: light after that many or more scatterings was
    // multiplied by `scale`.
    struct ClampResult {
        Vec3d radiance{0, 0, 0};
        int first_scaled = 0;
        double scale = 1;
    };
    // Adds the removed light to the statistics of the place.
    ClampResult clamp(size_t place, const TileScratch& tile, int slot);

    // Light removed at a place, and the number of samples it was removed from. Only while clamping is on.
    struct ClampedSums {
        ExactSum3 removed;
        int64_t samples = 0;
    };
    ClampedSums& account(size_t place) { return accounts_[place]; }
    const ClampedSums& account(size_t place) const { return accounts_[place]; }

private:
    Clamp clamp_;
    std::vector<ClampedSums> accounts_; // empty while clamping is off
};

} // namespace blush
