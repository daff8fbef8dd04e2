// Counts of paths by bounce.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace blush {

constexpr int max_counted_bounces = 64; // the last counts all further ones

// Counts at one bounce.
struct PathCounts {
    int64_t alive = 0;      // traced rays; at bounce 0 camera rays
    int64_t rr_applied = 0; // paths to which Russian roulette was applied,
    int64_t survived = 0;   // and those that survived it
    PathCounts& operator+=(const PathCounts& more) {
        alive += more.alive;
        rr_applied += more.rr_applied;
        survived += more.survived;
        return *this;
    }
    bool operator==(const PathCounts&) const = default;
};

// Adds the counts of a worker to `sums` and clears them.
inline void move_counts(PathCounts (&counts)[max_counted_bounces], std::vector<PathCounts>& sums) {
    sums.resize(max_counted_bounces);
    for (size_t k = 0; k < sums.size(); ++k) sums[k] += std::exchange(counts[k], {});
}

} // namespace blush
