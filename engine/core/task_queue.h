// Task queue: runs tasks on other threads while the calling thread continues.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace blush {

// Threads of a task queue. They have the priority of the creating thread (low beside a window) and its floating-point settings,
// so that results do not depend on the thread.
class TaskQueue {
public:
    // `threads` includes the calling one; 0: one per core. With 1 all tasks run in finish().
    explicit TaskQueue(unsigned threads = 0);
    // Waits for running tasks; exceptions are dropped.
    ~TaskQueue();
    TaskQueue(const TaskQueue&) = delete;
    TaskQueue& operator=(const TaskQueue&) = delete;

    // Queues task(i) for each of `sizes`, in any order, and returns immediately. Tasks larger than `large` run one at a time
    // beside the others, which limits memory.
    void begin(const std::vector<int64_t>& sizes, int64_t large, std::function<void(size_t)> task);
    // Runs tasks on this thread too until all are done. Rethrows an exception of a task.
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace blush
