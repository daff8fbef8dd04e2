// Ctrl-C as a stop request.
#pragma once

#include <atomic>

namespace blush {

// While an object exists, the first SIGINT or SIGTERM only sets a flag; the second ends the process.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    const std::atomic<bool>& interrupted() const;
};

} // namespace blush
