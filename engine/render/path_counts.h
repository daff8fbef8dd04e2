// How many paths got how far.
#pragma once

#include <cstdint>

namespace blush {

constexpr int most_counted_bounces = 64; // the last counts all further ones

// At one bounce.
struct PathCounts {
    int64_t alive = 0;    // rays that were traced: at bounce 0 the camera's
    int64_t asked = 0;    // paths that roulette was asked about before they went on,
    int64_t survived = 0; // and how many of them it let go
    bool operator==(const PathCounts&) const = default;
};

} // namespace blush
