// The number of threads under limits on memory and processes, which are set in child processes.
#include "core/startable_threads.h"

#include "core/sanitized.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <latch>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace blush::TEST_FILE {
namespace {

// The exit code of a child process, which knows no more threads than this process has started; 255 if it was killed.
unsigned in_child(const std::function<unsigned()>& run) {
    const pid_t child = fork();
    if (child == 0) _exit(int(run()));
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? unsigned(WEXITSTATUS(status)) : 255;
}

TEST(StartableThreads, AreAsManyAsWantedWithoutLimits) {
    EXPECT_EQ(startable_threads(1), 1u);
    EXPECT_EQ(startable_threads(3), 3u);
    EXPECT_EQ(in_child([] { return startable_threads(1'000'000) <= startable_threads_limit() ? 1u : 0u; }), 1u);
}

// Sanitizers reserve more address space and start threads of their own.
#ifndef BLUSH_SANITIZED
constexpr unsigned wanted = 200; // more than any other test of this process has started

// True if this thread and others, `count` in all, run at the same time.
bool can_run(unsigned count) {
    std::vector<std::thread> threads;
    std::latch end(1);
    bool started = true;
    try {
        while (threads.size() + 1 < count) threads.emplace_back([&] { end.wait(); });
    } catch (const std::system_error&) { started = false; }
    end.count_down();
    for (std::thread& thread : threads) thread.join();
    return started;
}

// startable_threads(wanted) in a child for which limit() has returned true; 0 if that many do not start, or the answer changes.
unsigned startable_under(const std::function<bool()>& limit) {
    return in_child([&] {
        if (!limit()) return 0u;
        const unsigned count = startable_threads(wanted);
        const bool stays = startable_threads(wanted + 10) == count && startable_threads(1) == 1;
        return stays && can_run(count) ? count : 0;
    });
}

TEST(StartableThreads, FitIntoTheAddressSpace) {
    constexpr rlim_t stack = 8 << 20;
    constexpr unsigned kept = 5; // stacks of ended threads that glibc keeps
    const unsigned count = startable_under([] {
        rlimit stacks{};
        size_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        const rlim_t most = pages * size_t(sysconf(_SC_PAGESIZE)) + 20 * stack;
        const rlimit space{most, most};
        return getrlimit(RLIMIT_STACK, &stacks) == 0 && stacks.rlim_cur >= stack && setrlimit(RLIMIT_AS, &space) == 0;
    });
    EXPECT_GE(count, 2u);
    EXPECT_LE(count, 21 + kept) << "each needs a stack";
}

// The limit counts the processes of a user, and root has none: the child becomes a user with no other process.
TEST(StartableThreads, KeepToTheLimitOfProcesses) {
    if (geteuid() != 0) GTEST_SKIP() << "only root can become another user";
    EXPECT_EQ(startable_under([] {
                  const rlimit processes{7, 7};
                  return setrlimit(RLIMIT_NPROC, &processes) == 0 && setuid(61234) == 0;
              }),
              7u);
}
#endif

} // namespace
} // namespace blush::TEST_FILE
