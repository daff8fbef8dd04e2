// A job on its own thread, with progress and a cancel flag. The UI thread polls for the result once per frame.
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

// Progress and cancel flag of a running job. Shared by the two threads.
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

// The destructor cancels the job and joins its thread.
template <class T> class BackgroundJob {
public:
    // `wake` is called on the job's thread when the result is available. `work` must not throw.
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

    // Returns the result once; nullopt while the job is running.
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
    std::thread thread_; // last member: starts after everything else is initialised
};

} // namespace blush
