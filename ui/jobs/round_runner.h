// Repeats a measurement in rounds on its own thread, with a growing number of samples.
#pragma once

#include "core/parallel.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace blush {

// `Work` is created and used only on that thread:
//     struct Input;                                     with bool has_same_result(const Input&) const
//     struct Output;
//     void begin(const Input&);
//     bool round(const std::function<bool()>& wanted);  false if it was cancelled because wanted() is false: the runner ends, or
//                                                       another input waits, with which begin() is called next
//     Output output() const;                            from the rounds so far
//     static bool is_good(const Output&);               true if more rounds would not improve it
// Exceptions thrown by begin() and round() are reported as a failure.
template <class Work> class RoundRunner {
public:
    using Input = typename Work::Input;
    using Output = typename Work::Output;

    RoundRunner() : thread_([this] { run(); }) {}
    // Cancels the current round and joins the thread.
    ~RoundRunner() {
        {
            const std::lock_guard lock(mutex_);
            quit_ = true;
        }
        wake_.notify_one();
        thread_.join();
    }
    RoundRunner(const RoundRunner&) = delete;
    RoundRunner& operator=(const RoundRunner&) = delete;

    // Restarts if this input differs from the current one. Does not block.
    void measure(Input input) {
        {
            const std::lock_guard lock(mutex_);
            const bool same = last_ && last_->has_same_result(input);
            // Kept even if it is the same: it shares storage with the next, whose comparison then reads no table.
            last_ = std::move(input);
            if (same) return;
            pending_ = last_;
            superseded_ = true;
            state_ = {};
        }
        wake_.notify_one();
    }

    struct State {
        Output output = {};  // default-constructed before the first round
        bool rests = false;  // accurate enough; no more rounds
        std::string failure; // error message; empty: none
    };
    State state() const {
        const std::lock_guard lock(mutex_);
        return state_;
    }

private:
    void render_batch(Work& work, const std::optional<Input>& input) {
        State state;
        try {
            if (input) work.begin(*input);
            if (!work.round([this] { return !quit_ && !superseded_; })) return;
            state.output = work.output();
            state.rests = Work::is_good(state.output);
        } catch (const std::exception& e) { state.failure = e.what(); }
        const std::lock_guard lock(mutex_);
        if (!pending_) state_ = std::move(state); // otherwise it is the result of an outdated input
    }

    void run() {
        lower_priority_of_this_thread();
        Work work;
        for (;;) {
            std::optional<Input> input;
            {
                std::unique_lock lock(mutex_);
                wake_.wait(lock, [&] { return quit_ || pending_ || (last_ && !state_.rests && state_.failure.empty()); });
                if (quit_) return;
                input.swap(pending_);
                superseded_ = false;
            }
            render_batch(work, input);
        }
    }

    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::optional<Input> last_, pending_;
    State state_;
    std::atomic<bool> quit_{false};
    std::atomic<bool> superseded_{false}; // there is a pending input
    std::thread thread_;                  // last member: starts after everything else is initialised
};

} // namespace blush
