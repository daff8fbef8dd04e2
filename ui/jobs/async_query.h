// Computes a value for a question on another thread, again whenever the question changes. For statistics that would block the UI
// thread.
#pragma once

#include "ui/jobs/background_job.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

namespace blush {

template <class Question, class Answer> class AsyncQuery {
public:
    // `answer_it` runs on another thread and must not throw. Answers use at most a fifth of one core's time, which the renderer
    // needs.
    // True while there is no answer to this question yet.
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
    // The latest answer; null before the first.
    const Answer* answer() const { return answer_ ? &*answer_ : nullptr; }
    // Its number, counted from 1; 0 before the first.
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
    std::shared_ptr<BackgroundJob<Answer>> job_; // shared, because the owner is copied
    Clock::time_point began_{}, next_{};
};

} // namespace blush
