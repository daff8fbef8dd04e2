// Computes a value for an input on another thread, again whenever the input changes. For statistics that would block the UI
// thread.
#pragma once

#include "ui/jobs/background_job.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

namespace blush {

template <class Input, class Output> class AsyncQuery {
public:
    // `compute` runs on another thread and must not throw. It uses at most a fifth of one core's time, which the renderer
    // needs.
    // True while there is no result for this input yet.
    bool update(const Input& input, Output (*compute)(const Input&)) {
        take();
        if (!job_ && (!input_ || *input_ != input) && Clock::now() >= next_) {
            input_ = input;
            began_ = Clock::now();
            job_ = std::make_shared<BackgroundJob<Output>>(
                "", [input, compute](JobProgress&) { return compute(input); }, [] {});
        }
        return job_ || !input_ || *input_ != input;
    }
    // The latest result; null before the first.
    const Output* output() const { return output_ ? &*output_ : nullptr; }
    // Its number, counted from 1; 0 before the first.
    uint64_t number() const { return number_; }

private:
    using Clock = std::chrono::steady_clock;
    void take() {
        if (!job_) return;
        auto done = job_->take();
        if (!done) return;
        output_ = *std::move(done);
        ++number_;
        job_.reset();
        next_ = Clock::now() + 4 * (Clock::now() - began_);
    }

    std::optional<Input> input_;
    std::optional<Output> output_;
    uint64_t number_ = 0;
    std::shared_ptr<BackgroundJob<Output>> job_; // shared, because the owner is copied
    Clock::time_point began_{}, next_{};
};

} // namespace blush
