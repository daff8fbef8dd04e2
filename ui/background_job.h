// One piece of work on a thread of its own, with progress and a cancel flag; the UI thread asks for the result once per frame.
#pragma once

#include "core/parallel.h"

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace blush {

// What a running job says and hears. Shared by the two threads.
class JobProgress {
public:
    void report(double fraction, std::string what) {
        const std::lock_guard lock(mutex_);
        fraction_ = fraction;
        what_ = std::move(what);
    }
    std::pair<double, std::string> read() const {
        const std::lock_guard lock(mutex_);
        return {fraction_, what_};
    }
    std::atomic<bool> cancel = false;

private:
    mutable std::mutex mutex_;
    double fraction_ = 0;
    std::string what_;
};

// Destroying a job cancels it and waits for its thread.
template <class T> class BackgroundJob {
public:
    // `wake` is called on the job's thread when the result is there. `work` must not throw.
    BackgroundJob(std::string title, std::function<T(JobProgress&)> work, std::function<void()> wake)
        : title_(std::move(title)), thread_([this, work = std::move(work), wake = std::move(wake)] {
              lower_priority_of_this_thread();
              T result = work(progress_);
              {
                  const std::lock_guard lock(mutex_);
                  result_ = std::move(result);
              }
              wake();
          }) {}
    ~BackgroundJob() {
        cancel();
        thread_.join();
    }
    BackgroundJob(const BackgroundJob&) = delete;
    BackgroundJob& operator=(const BackgroundJob&) = delete;

    // The result, once; nothing while the work goes on.
    std::optional<T> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(result_, std::nullopt);
    }
    void cancel() { progress_.cancel = true; }
    bool cancelled() const { return progress_.cancel; }
    const std::string& title() const { return title_; }
    const JobProgress& progress() const { return progress_; }

private:
    std::string title_;
    JobProgress progress_;
    std::mutex mutex_;
    std::optional<T> result_;
    std::thread thread_; // last: starts when everything else is there
};

} // namespace blush
