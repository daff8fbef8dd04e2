// Work that other threads begin while the one that wants it does something else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace blush {

// Threads that help the one that makes them, at its priority (beside a window: a low one) and with its floating-point settings, so that a
// result does not depend on who computed it.
class HelpingThreads {
public:
    // Together with the one that makes them; 0: one per core. With 1 nothing is done before finish().
    explicit HelpingThreads(unsigned threads = 0);
    // Waits for what has been begun; what throws is lost.
    ~HelpingThreads();
    HelpingThreads(const HelpingThreads&) = delete;
    HelpingThreads& operator=(const HelpingThreads&) = delete;

    // Calls task(i) once for each of `sizes`, in any order, and returns at once. Those larger than `large` are done one after another, beside
    // the others: what they need at the same time stays bounded.
    void begin(const std::vector<int64_t>& sizes, int64_t large, std::function<void(size_t)> task);
    // Works along until all is done. Throws what a task has thrown.
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace blush
