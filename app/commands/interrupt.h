// Ctrl-C as a request instead of an end.
#pragma once

#include <atomic>

namespace blush {

// While one lives, the first SIGINT or SIGTERM is only noted; the second ends the process, as ever.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    const std::atomic<bool>& interrupted() const;
};

} // namespace blush
