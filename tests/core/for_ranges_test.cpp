// Loops over ranges: each element once, whatever the number of threads; sums, exceptions.
#include "core/for_ranges.h"

#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>
#include <vector>

namespace blush::TEST_FILE {
namespace {

constexpr size_t long_loop = 1'000'003, short_loop = 1000;

TEST(ForRanges, VisitEachElementOnce) {
    for (const unsigned threads : {0u, 1u, 2u, 5u})
        for (const size_t count : {size_t(0), size_t(1), short_loop, long_loop}) {
            std::vector<uint8_t> visits(count);
            for_ranges(count, threads, [&](size_t begin, size_t end) {
                for (size_t i = begin; i < end; ++i) ++visits[i];
            });
            EXPECT_EQ(visits, std::vector<uint8_t>(count, 1)) << threads << " threads";
        }
}

TEST(ForRanges, ShortLoopsStayOnThisThread) {
    const std::thread::id here = std::this_thread::get_id();
    int calls = 0;
    for_ranges(short_loop, 4, [&](size_t begin, size_t end) {
        EXPECT_EQ(std::this_thread::get_id(), here);
        EXPECT_EQ(end - begin, short_loop);
        ++calls;
    });
    for_ranges(0, 4, [&](size_t, size_t) { ++calls; });
    EXPECT_EQ(calls, 1);
}

TEST(ForRanges, LongLoopsAreDivided) {
    std::atomic<int> calls = 0;
    for_ranges(long_loop, 2, [&](size_t, size_t) { ++calls; });
    EXPECT_GT(calls, 2);
}

TEST(ForRanges, AddUpRanges) {
    for (const unsigned threads : {1u, 3u})
        for (const size_t count : {size_t(0), short_loop, long_loop}) {
            EXPECT_EQ(sum_of_ranges(count, threads, [](size_t begin, size_t end) { return end - begin; }), count);
            EXPECT_EQ(count_in_ranges(count, threads, [](size_t i) { return i % 3 == 0; }), (count + 2) / 3);
        }
}

TEST(ForRanges, RethrowExceptions) {
    for (const size_t count : {short_loop, long_loop})
        EXPECT_THROW(for_ranges(count, 3,
                                [&](size_t begin, size_t end) {
                                    if (begin <= count / 2 && count / 2 < end) throw std::runtime_error("half");
                                }),
                     std::runtime_error);
}

} // namespace
} // namespace blush::TEST_FILE
