// A question about what is shown, answered on a thread of its own, again whenever it differs: figures that would hold the window up.
#pragma once

#include "ui/background_job.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

namespace blush {

template <class Question, class Answer> class BackgroundAnswer {
public:
    // `answer_it` is called on another thread, and must not throw. Answers take a fifth of one core's time at most: rendering needs it.
    // True while the answer to this very question is not there yet.
    bool ask(const Question& question, Answer (*answer_it)(const Question&)) {
        take();
        if (!job_ && (!asked_ || *asked_ != question) && Clock::now() >= next_) {
            asked_ = question;
            began_ = Clock::now();
            job_ = std::make_shared<BackgroundJob<Answer>>(
                "", [question, answer_it](JobProgress&) { return answer_it(question); }, [] {});
        }
        return job_ || !asked_ || *asked_ != question;
    }
    // The newest; null before the first.
    const Answer* answer() const { return answer_ ? &*answer_ : nullptr; }
    // Of that answer, counted from 1; 0 before the first.
    uint64_t number() const { return number_; }

private:
    using Clock = std::chrono::steady_clock;
    void take() {
        if (!job_) return;
        auto done = job_->take();
        if (!done) return;
        answer_ = *std::move(done);
        ++number_;
        job_.reset();
        next_ = Clock::now() + 4 * (Clock::now() - began_);
    }

    std::optional<Question> asked_;
    std::optional<Answer> answer_;
    uint64_t number_ = 0;
    std::shared_ptr<BackgroundJob<Answer>> job_; // shared, since what holds it is copied
    Clock::time_point began_{}, next_{};
};

} // namespace blush
