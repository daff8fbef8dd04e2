// Pauses work that runs in small pieces while others need the processor.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>

namespace blush {

// Thread-safe. Open at first.
class PauseGate {
public:
    void close();
    void open();
    bool is_closed() const { return closed_.load(std::memory_order_relaxed); }
    // Blocks while closed, unless interrupted() becomes true. One relaxed load when open.
    void wait_while_closed(const std::function<bool()>& interrupted);
    bool has_waiting_threads() const { return waiting_.load(std::memory_order_relaxed) > 0; }
    // Wakes waiting threads to call `interrupted` again.
    void notify();
    // Total seconds closed so far.
    double closed_seconds() const;

private:
    using Clock = std::chrono::steady_clock;

    std::atomic<bool> closed_{false};
    std::atomic<int> waiting_{0};
    mutable std::mutex mutex_; // guards the following, and changes of closed_
    std::condition_variable changed_;
    Clock::time_point closed_since_{};
    Clock::duration closed_before_{}; // total of finished closures
};

} // namespace blush
