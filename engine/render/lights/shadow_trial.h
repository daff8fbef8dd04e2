// A shadow ray and whether it arrived, as the pilot of learned visibility records it.
#pragma once

#include "core/vec.h"

#include <cstdint>

namespace blush {

struct ShadowTrial {
    Vec3 position, normal; // of the receiver; zero normal: light from all sides
    int32_t light;         // record
    bool arrived;
    float transmittance = 1; // of blended surfaces on its way
};

} // namespace blush
