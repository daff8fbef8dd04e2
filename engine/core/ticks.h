// Time stamps for profiles inside kernels: one instruction, where a clock would be a call that spills all vector registers.
#pragma once

#include <cstdint>

namespace blush {

// The processor's time-stamp counter. Its rate is constant and the same on all cores, but its unit is unknown: compare with a clock.
inline int64_t ticks() { return int64_t(__builtin_ia32_rdtsc()); }

} // namespace blush
