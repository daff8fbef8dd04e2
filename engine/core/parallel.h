// Parallel loops with a given number of threads and cancellation.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace blush {

// Lowers the priority of background threads, so that they do not delay the UI thread.
void lower_priority_of_this_thread();

// A group of worker threads. All of them flush denormals to zero (Embree requires it, and results must not depend on the thread).
// With low priority they do not starve the UI thread.
class Workers {
public:
    // 0 threads: one per core.
    explicit Workers(unsigned threads, bool low_priority = false);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    unsigned threads() const { return threads_; }
    // Calls task(i, worker) for every i in [0, count), worker < threads(). Items that have not started when `wanted` returns
    // false are skipped. True if all items were done.
    bool for_each(int64_t count, const std::function<bool()>& wanted, const std::function<void(int64_t i, unsigned worker)>& task) const;
    // Runs `task` inside the TBB arena: nested TBB work (an Embree build) uses these threads.
    void run(const std::function<void()>& task) const;

private:
    struct State;
    unsigned threads_;
    std::unique_ptr<State> state_;
};

} // namespace blush
