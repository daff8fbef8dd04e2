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
//     struct Question;                                  with bool asks_the_same(const Question&) const
//     struct Answer;
//     void begin(const Question&);
//     bool round(const std::function<bool()>& wanted);  false if it was cancelled because wanted() is false
//     Answer answer() const;                            from the rounds so far
//     static bool is_good(const Answer&);               true if more rounds would not improve it
// Exceptions thrown by begin() and round() are reported as a failure.
template <class Work> class RoundRunner {
public:
    using Question = typename Work::Question;
    using Answer = typename Work::Answer;

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

    // Restarts if this question differs from the current one. Does not block.
    void measure(Question question) {
        {
            const std::lock_guard lock(mutex_);
            if (last_ && last_->asks_the_same(question)) return;
            last_ = std::move(question);
            pending_ = last_;
            state_ = {};
        }
        wake_.notify_one();
    }

    struct State {
        Answer answer = {};  // default-constructed before the first round
        bool rests = false;  // accurate enough; no more rounds
        std::string failure; // error message; empty: none
    };
    State state() const {
        const std::lock_guard lock(mutex_);
        return state_;
    }

private:
    void render_batch(Work& work, const std::optional<Question>& question) {
        State state;
        try {
            if (question) work.begin(*question);
            if (!work.round([this] { return !quit_; })) return;
            state.answer = work.answer();
            state.rests = Work::is_good(state.answer);
        } catch (const std::exception& e) { state.failure = e.what(); }
        const std::lock_guard lock(mutex_);
        if (!pending_) state_ = std::move(state); // otherwise it answers an outdated question
    }

    void run() {
        lower_priority_of_this_thread();
        Work work;
        for (;;) {
            std::optional<Question> question;
            {
                std::unique_lock lock(mutex_);
                wake_.wait(lock, [&] { return quit_ || pending_ || (last_ && !state_.rests && state_.failure.empty()); });
                if (quit_) return;
                question.swap(pending_);
            }
            render_batch(work, question);
        }
    }

    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::optional<Question> last_, pending_;
    State state_;
    std::atomic<bool> quit_{false};
    std::thread thread_; // last member: starts after everything else is initialised
};

} // namespace blush
