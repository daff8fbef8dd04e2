#include "render/gate.h"

namespace blush {

void Gate::shut() {
    const std::lock_guard lock(mutex_);
    if (shut_) return;
    shut_ = true;
    shut_since_ = Clock::now();
}

void Gate::open() {
    {
        const std::lock_guard lock(mutex_);
        if (!shut_) return;
        shut_ = false;
        shut_before_ += Clock::now() - shut_since_;
    }
    changed_.notify_all();
}

void Gate::pass(const std::function<bool()>& hurries) {
    if (!is_shut()) return;
    std::unique_lock lock(mutex_);
    ++waiting_;
    changed_.wait(lock, [&] { return !shut_ || hurries(); });
    --waiting_;
}

void Gate::look_again() {
    { const std::lock_guard lock(mutex_); } // after this, a thread that evaluated its predicate is waiting
    changed_.notify_all();
}

double Gate::shut_seconds() const {
    const std::lock_guard lock(mutex_);
    return std::chrono::duration<double>(shut_before_ + (shut_ ? Clock::now() - shut_since_ : Clock::duration())).count();
}

} // namespace blush
