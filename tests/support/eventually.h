// Waits with a limit: a test that would hang fails instead, with the name of the missing event.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <gtest/gtest.h>
#include <iostream>
#include <mutex>
#include <string>
#include <thread>

namespace blush::test {

// Far above what any wait takes on a busy machine, with sanitizers too: after this time it is a hang.
constexpr std::chrono::minutes patience{4};

// Returns as soon as done() is true. Fails after `patience`.
template <class Done> testing::AssertionResult eventually(Done done) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!done()) {
        if (std::chrono::steady_clock::now() > end)
            return testing::AssertionFailure() << "waited for it " << patience.count() << " minutes";
        std::this_thread::yield();
    }
    return testing::AssertionSuccess();
}

// Ends the process with a message if the object exists for longer than `patience`: for calls that may never return, such as joining a
// thread or destroying a session.
class HangGuard {
public:
    // `what` completes the sentence "... did not end".
    explicit HangGuard(std::string what)
        : thread_([this, what = std::move(what)] {
              std::unique_lock lock(mutex_);
              if (changed_.wait_for(lock, patience, [&] { return over_; })) return;
              std::cerr << "[  FAILED  ] " << what << " did not end within " << patience.count() << " minutes" << std::endl;
              std::abort();
          }) {}
    ~HangGuard() {
        {
            const std::lock_guard lock(mutex_);
            over_ = true;
        }
        changed_.notify_all();
        thread_.join();
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    bool over_ = false;
    std::thread thread_; // last member: its function uses the others
};

} // namespace blush::test
