// Time stamps for profiles inside kernels: one instruction, where a clock would be a call that spills all vector registers.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace blush {

// The processor's time-stamp counter. Its rate is constant and the same on all cores, but its unit is unknown: compare with a clock.
inline int64_t ticks() { return int64_t(__builtin_ia32_rdtsc()); }

// The rate of ticks against a clock, since construction.
class TickRate {
public:
    double seconds_per_tick() const {
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begun_;
        return seconds.count() / double(std::max<int64_t>(ticks() - first_, 1));
    }

private:
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
    int64_t first_ = ticks();
};

} // namespace blush
