// Task queue: each task runs once, exceptions, priority, floating-point mode.
#include "core/parallel.h"
#include "core/task_queue.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <gtest/gtest.h>
#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <thread>
#include <unistd.h>

namespace blush::TEST_FILE {
namespace {

void sleep_briefly() { std::this_thread::sleep_for(std::chrono::microseconds(100)); }

TEST(TaskQueue, RunEachTaskOnce) {
    for (const unsigned threads : {0u, 1u, 2u, 7u})
        for (const size_t count : {0, 1, 5, 3000}) {
            std::vector<std::atomic<int>> done(count);
            std::vector<int64_t> sizes;
            for (size_t i = 0; i < count; ++i) sizes.push_back(i % 10 ? 1 : 100);
            TaskQueue helpers(threads);
            helpers.begin(sizes, 10, [&](size_t i) { ++done[i]; });
            helpers.finish();
            for (const auto& times : done) ASSERT_EQ(times, 1) << threads << " threads, " << count << " pieces";
        }
}

TEST(TaskQueue, RunLargeTasksOneAtATime) {
    std::atomic<int> at_once = 0, most = 0;
    TaskQueue helpers(4);
    helpers.begin(std::vector<int64_t>(50, 11), 10, [&](size_t) {
        most = std::max(most.load(), ++at_once);
        sleep_briefly();
        --at_once;
    });
    helpers.finish();
    EXPECT_EQ(most, 1);
}

TEST(TaskQueue, RethrowExceptionsAndContinue) {
    for (const unsigned threads : {1u, 4u}) {
        TaskQueue helpers(threads);
        helpers.begin(std::vector<int64_t>(100, 1), 1, [](size_t i) {
            if (i == 50) throw std::runtime_error("fifty");
        });
        EXPECT_THROW(helpers.finish(), std::runtime_error);
        std::atomic<int> done = 0;
        helpers.begin(std::vector<int64_t>(100, 1), 1, [&](size_t) { ++done; });
        helpers.finish();
        EXPECT_EQ(done, 100);
    }
    TaskQueue left_alone(4);
    left_alone.begin({1, 1}, 1, [](size_t) { throw std::runtime_error("not collected"); });
}

// The threads that take tasks. Each waits for a second one, so that a test of what other threads inherit cannot pass without any.
class TwoThreads {
public:
    void wait() {
        std::unique_lock lock(mutex_);
        threads_.insert(std::this_thread::get_id());
        changed_.notify_all();
        changed_.wait_for(lock, std::chrono::seconds(30), [&] { return threads_.size() > 1; });
    }
    size_t count() const { return threads_.size(); }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::set<std::thread::id> threads_;
};

// A nice value cannot be lowered again: uses separate threads that end with the test.
TEST(TaskQueue, InheritThePriority) {
    std::mutex mutex;
    int lowest = std::numeric_limits<int>::max(), own = 0;
    TwoThreads threads;
    std::thread([&] {
        lower_priority_of_this_thread();
        own = getpriority(PRIO_PROCESS, id_t(syscall(SYS_gettid)));
        TaskQueue helpers(4);
        helpers.begin(std::vector<int64_t>(200, 1), 1, [&](size_t) {
            threads.wait();
            const std::scoped_lock lock(mutex);
            lowest = std::min(lowest, getpriority(PRIO_PROCESS, id_t(syscall(SYS_gettid))));
        });
        helpers.finish();
    }).join();
    EXPECT_GE(threads.count(), 2u);
    EXPECT_GT(own, 0);
    EXPECT_GE(lowest, own);
}

TEST(TaskQueue, InheritTheFloatingPointMode) {
    // Uses a separate thread that flushes denormals to zero.
    std::thread([] { Workers(4, false).for_each(100, {}, [](int64_t, unsigned) { sleep_briefly(); }); }).join();
    std::atomic<int> flushed = 0;
    TwoThreads threads;
    std::thread([&] {
        TaskQueue helpers(4);
        volatile float smallest = std::numeric_limits<float>::min();
        helpers.begin(std::vector<int64_t>(200, 1), 1, [&](size_t) {
            threads.wait();
            flushed += smallest / 2 == 0;
        });
        helpers.finish();
    }).join();
    EXPECT_GE(threads.count(), 2u);
    EXPECT_EQ(flushed, 0);
}

} // namespace
} // namespace blush::TEST_FILE
