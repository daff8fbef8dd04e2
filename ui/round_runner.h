// Measures something round after round on a thread of its own, while somebody looks.
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

// What is done there is `Work`, made and used on that thread alone:
//     struct Question;                                  with bool asks_the_same(const Question&) const
//     struct Answer;
//     void begin(const Question&);
//     bool round(const std::function<bool()>& wanted);  false if it was given up because it is not wanted any more
//     Answer answer() const;                            from the rounds so far
//     static bool is_good(const Answer&);               further rounds are of no use
// What begin() and round() throw is told as a failure.
template <class Work> class RoundRunner {
public:
    using Question = typename Work::Question;
    using Answer = typename Work::Answer;

    RoundRunner() : thread_([this] { run(); }) {}
    // Gives up the round it is in.
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

    // Starts anew if this differs from what is measured. Does not wait.
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
        Answer answer = {};  // from no round at first
        bool rests = false;  // it is as good as is of use
        std::string failure; // why there is none
    };
    State state() const {
        const std::lock_guard lock(mutex_);
        return state_;
    }

private:
    void work_once(Work& work, const std::optional<Question>& question) {
        State state;
        try {
            if (question) work.begin(*question);
            if (!work.round([this] { return !quit_; })) return;
            state.answer = work.answer();
            state.rests = Work::is_good(state.answer);
        } catch (const std::exception& e) { state.failure = e.what(); }
        const std::lock_guard lock(mutex_);
        if (!pending_) state_ = std::move(state); // else it answers something that nobody asks any more
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
            work_once(work, question);
        }
    }

    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::optional<Question> last_, pending_;
    State state_;
    std::atomic<bool> quit_{false};
    std::thread thread_; // last: starts when everything else is there
};

} // namespace blush
