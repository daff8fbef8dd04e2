// Counts of paths by bounce.
#pragma once

#include <cstdint>

namespace blush {

constexpr int max_counted_bounces = 64; // the last counts all further ones

// Counts at one bounce.
struct PathCounts {
    int64_t alive = 0;      // traced rays; at bounce 0 camera rays
    int64_t rr_applied = 0; // paths to which Russian roulette was applied,
    int64_t survived = 0;   // and those that survived it
    bool operator==(const PathCounts&) const = default;
};

} // namespace blush
