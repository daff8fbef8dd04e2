// How much of a picture's light came by how many scatterings.
#pragma once

#include "render/frame.h"

#include <string>
#include <vector>

namespace blush {

struct BounceEnergy {
    std::string name;      // "0", "1", ..., of the last plane "7+"
    Vec3d mean{0, 0, 0};   // over the image, scene-linear RGB
    double share = 0;      // of the luminance of the whole image, 0 .. 1; 0 for a black image
    bool operator==(const BounceEnergy&) const = default;
};

// Of a frame's bounce planes, in order; empty if it has none.
std::vector<BounceEnergy> bounce_energy(const Frame& frame);

} // namespace blush
