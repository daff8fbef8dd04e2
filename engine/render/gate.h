// Pauses work that runs in small pieces while others need the processor.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>

namespace blush {

// Thread-safe. Open at first.
class Gate {
public:
    void shut();
    void open();
    bool is_shut() const { return shut_.load(std::memory_order_relaxed); }
    // Blocks while closed, unless hurries() becomes true. One relaxed load when open.
    void pass(const std::function<bool()>& hurries);
    bool holds_anyone() const { return waiting_.load(std::memory_order_relaxed) > 0; }
    // Wakes waiting threads to call `hurries` again.
    void look_again();
    // Total seconds closed so far.
    double shut_seconds() const;

private:
    using Clock = std::chrono::steady_clock;

    std::atomic<bool> shut_{false};
    std::atomic<int> waiting_{0};
    mutable std::mutex mutex_; // guards the following, and changes of shut_
    std::condition_variable changed_;
    Clock::time_point shut_since_{};
    Clock::duration shut_before_{}; // total of finished closures
};

} // namespace blush
