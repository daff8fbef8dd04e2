// Chains of parts: which samples count once, and which are missing.
#include "app/commands/plan/parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

namespace blush::TEST_FILE {
namespace {

std::vector<Part> parts_of(std::vector<SampleSpan> ranges) {
    std::ranges::sort(ranges, {}, [](SampleSpan s) { return std::tuple(s.first, s.last); });
    std::vector<Part> parts;
    for (const SampleSpan s : ranges) parts.push_back({"", s, 0});
    return parts;
}

std::vector<SampleSpan> ranges_of(const std::vector<Part>& parts) {
    std::vector<SampleSpan> ranges;
    for (const Part& part : parts) ranges.push_back(part.samples);
    return ranges;
}

TEST(PlanParts, ChainEndsAtTheFirstGap) {
    const std::vector<Part> parts = parts_of({{0, 8}, {8, 16}, {24, 32}});
    EXPECT_EQ(ranges_of(chain_of(parts, {0, 32})), (std::vector<SampleSpan>{{0, 8}, {8, 16}}));
    EXPECT_EQ(missing_in(parts, {0, 32}), (SampleSpan{16, 24}));
    EXPECT_EQ(missing_in(parts, {0, 16}).first, missing_in(parts, {0, 16}).last);
    EXPECT_TRUE(chain_of(parts, {16, 24}).empty());
    EXPECT_EQ(missing_in({}, {16, 24}), (SampleSpan{16, 24}));
}

// Two workers were stopped at different samples of one task, and one of them has gone on since.
TEST(PlanParts, OverlapsCountOnce) {
    const std::vector<Part> parts = parts_of({{0, 5}, {0, 7}, {5, 16}, {7, 9}});
    EXPECT_EQ(ranges_of(chain_of(parts, {0, 16})), (std::vector<SampleSpan>{{0, 5}, {5, 16}}));
    EXPECT_EQ(missing_in(parts_of({{0, 5}, {0, 7}, {12, 16}, {10, 16}}), {0, 16}), (SampleSpan{7, 10}));
    EXPECT_EQ(missing_in(parts_of({{0, 20}}), {0, 16}), (SampleSpan{0, 16})) << "a part of another task's samples is of no use";
}

// Against all subsets.
TEST(PlanParts, EqualsASearchOfAllChains) {
    std::mt19937 random(7);
    const auto below = [&](int64_t n) { return int64_t(random() % uint64_t(n)); };
    for (int trial = 0; trial < 500; ++trial) {
        constexpr int64_t end = 10;
        std::vector<SampleSpan> ranges;
        for (int64_t i = below(7); i >= 0; --i) {
            const int64_t first = below(end);
            ranges.push_back({first, first + 1 + below(end - first)});
        }
        int64_t farthest = 0, least = end;
        // Ends of chains from 0, and beginnings of chains to the end, by all orders of a subset: a chain is sorted.
        const std::vector<Part> parts = parts_of(ranges);
        std::vector<int64_t> from{0}, to{end};
        for (size_t subset = 0; subset < size_t(1) << parts.size(); ++subset) {
            std::vector<SampleSpan> chain;
            for (size_t i = 0; i < parts.size(); ++i)
                if (subset >> i & 1) chain.push_back(parts[i].samples);
            bool joined = !chain.empty();
            for (size_t i = 1; i < chain.size(); ++i) joined = joined && chain[i].first == chain[i - 1].last;
            if (joined && chain.front().first == 0) from.push_back(chain.back().last);
            if (joined && chain.back().last == end) to.push_back(chain.front().first);
        }
        for (const int64_t a : from) {
            farthest = std::max(farthest, a);
            for (const int64_t b : to)
                if (b >= a) least = std::min(least, b - a);
        }
        const std::vector<Part> chain = chain_of(parts, {0, end});
        EXPECT_EQ(chain.empty() ? 0 : chain.back().samples.last, farthest);
        for (size_t i = 0; i < chain.size(); ++i) EXPECT_EQ(chain[i].samples.first, i == 0 ? 0 : chain[i - 1].samples.last);
        const SampleSpan missing = missing_in(parts, {0, end});
        EXPECT_EQ(missing.last - missing.first, least);
    }
}

} // namespace
} // namespace blush::TEST_FILE
