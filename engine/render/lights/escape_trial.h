// A bounce ray and whether it escaped to the environment, as the pilot of learned portals records it.
#pragma once

#include "core/vec.h"

#include <cstdint>
#include <vector>

namespace blush {

struct EscapeTrial {
    Vec3 position, direction; // of the ray
    bool is_delta;            // of a delta lobe: light sampling cannot replace it
    bool escaped;
};

// The bounce rays of a tile, accumulated.
struct EscapeTrials {
    std::vector<EscapeTrial> all;
    size_t first = 0; // of the rays that are traced next, in the order of their queue

    // `geometry` of the hits of these `count` rays; negative: the ray escaped.
    void note_hits(const int32_t* geometry, int count) {
        for (int k = 0; k < count; ++k) all[first + size_t(k)].escaped = geometry[k] < 0;
    }
};

} // namespace blush
