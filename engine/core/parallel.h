// Work over tiles in parallel, in an arena of a given size, while it is still wanted.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace blush {

// For work that the thread that draws the window must not wait for.
void lower_priority_of_this_thread();

// A bounded group of worker threads. Denormals are flushed to zero in all of them (Embree asks for it, and results must
// not depend on which thread computed them); at low priority they never starve the thread that draws the window.
class Workers {
public:
    // 0 threads: one per core.
    explicit Workers(unsigned threads, bool low_priority = false);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    unsigned threads() const { return threads_; }
    // Calls task(i, worker) for every i in [0, count), worker < threads(); items not begun when `wanted` turns false are left
    // out. True if all were done.
    bool for_each(int64_t count, const std::function<bool()>& wanted, const std::function<void(int64_t i, unsigned worker)>& task) const;
    // Runs `task` inside the arena: what it hands to TBB (an Embree build) uses these threads.
    void run(const std::function<void()>& task) const;

private:
    struct State;
    unsigned threads_;
    std::unique_ptr<State> state_;
};

} // namespace blush
