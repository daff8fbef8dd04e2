// Contribution of each bounce to an image.
#pragma once

#include "render/frame.h"

#include <string>
#include <vector>

namespace blush {

struct BounceEnergy {
    std::string name;    // "0", "1", ..., for the last plane "7+"
    Vec3d mean{0, 0, 0}; // over the image, scene-linear RGB
    double share = 0;    // fraction of the image's luminance, 0 .. 1; 0 for a black image
    bool operator==(const BounceEnergy&) const = default;
};

// One entry per bounce plane of the frame, in order; empty if it has none.
std::vector<BounceEnergy> bounce_energy(const Frame& frame);

} // namespace blush
