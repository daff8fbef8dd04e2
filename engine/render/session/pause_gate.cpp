#include "render/session/pause_gate.h"

namespace blush {

void PauseGate::close() {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    closed_ = true;
    closed_since_ = Clock::now();
}

void PauseGate::open() {
    {
        const std::lock_guard lock(mutex_);
        if (!closed_) return;
        closed_ = false;
        closed_before_ += Clock::now() - closed_since_;
    }
    changed_.notify_all();
}

void PauseGate::wait_while_closed(const std::function<bool()>& interrupted) {
    if (!is_closed()) return;
    std::unique_lock lock(mutex_);
    ++waiting_;
    changed_.wait(lock, [&] { return !closed_ || interrupted(); });
    --waiting_;
}

void PauseGate::notify() {
    { const std::lock_guard lock(mutex_); } // after this, a thread that evaluated its predicate is waiting
    changed_.notify_all();
}

double PauseGate::closed_seconds() const {
    const std::lock_guard lock(mutex_);
    return std::chrono::duration<double>(closed_before_ + (closed_ ? Clock::now() - closed_since_ : Clock::duration())).count();
}

} // namespace blush
