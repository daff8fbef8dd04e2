// Contribution of each bounce, and of each strategy, to an image.
#pragma once

#include "render/frame.h"

#include <string>
#include <vector>

namespace blush {

struct PlaneEnergy {
    std::string name;    // "0", "1", ..., for the last bounce "7+"; "nee", ...
    Vec3d mean{0, 0, 0}; // over the image, scene-linear RGB
    double share = 0;    // fraction of the image's luminance, 0 .. 1; 0 for a black image
    bool operator==(const PlaneEnergy&) const = default;
};

// One entry per bounce plane of the frame, in order; empty if it has none.
std::vector<PlaneEnergy> bounce_energy(const Frame& frame);
// One entry per strategy plane of the frame, in the order of FoundBy; empty if it has none.
std::vector<PlaneEnergy> strategy_energy(const Frame& frame);

} // namespace blush
