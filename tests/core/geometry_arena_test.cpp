// Geometry arena: ranges are exclusive, memory is committed when written and returned with the range.
#include "core/geometry_arena.h"
#include "core/geometry_array.h"

#include "core/sanitized.h"
#include "core/vec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>
#include <sys/resource.h>

namespace blush::TEST_FILE {
namespace {

using Floats = GeometryArray<float>;
constexpr auto attribute = Attribute(200); // whose elements here are single floats

TEST(GeometryArena, RangesDoNotOverlapAndAreReused) {
    std::vector<std::pair<int64_t, ArenaRangePtr>> taken;
    for (const size_t count : {1, 5000, 1024, 70000}) taken.emplace_back(int64_t(count), reserve_arena_range(ArenaKind::vertices, count));
    for (const auto& [count, numbers] : taken) {
        ASSERT_TRUE(numbers);
        EXPECT_EQ(numbers->first() % 1024, 0);
        for (const auto& [other_count, other] : taken)
            EXPECT_TRUE(other == numbers || numbers->first() + count <= other->first() || other->first() + other_count <= numbers->first());
    }
    const int64_t first = taken[1].second->first();
    taken[1].second.reset();
    EXPECT_EQ(reserve_arena_range(ArenaKind::vertices, 5000)->first(), first) << "a free range is reused";
}

TEST(GeometryArena, AdjacentFreeRangesAreMerged) {
    for (const std::array<int, 3>& order : {std::array{0, 1, 2}, {2, 1, 0}, {0, 2, 1}, {1, 0, 2}}) {
        std::array<ArenaRangePtr, 3> three;
        for (ArenaRangePtr& numbers : three) numbers = reserve_arena_range(ArenaKind::indices, 4096);
        const ArenaRangePtr behind = reserve_arena_range(ArenaKind::indices, 1);
        const int64_t first = three[0]->first();
        for (const int i : order) three[size_t(i)].reset();
        EXPECT_EQ(reserve_arena_range(ArenaKind::indices, 3 * 4096)->first(), first);
    }
}

TEST(GeometryArena, TooLargeRangesAreRefused) {
    EXPECT_FALSE(reserve_arena_range(ArenaKind::vertices, size_t(arena_capacity(ArenaKind::vertices)) + 1));
    EXPECT_FALSE(reserve_arena_range(ArenaKind::indices, SIZE_MAX));
    const ArenaRangePtr all_but_few = reserve_arena_range(ArenaKind::vertices, size_t(arena_capacity(ArenaKind::vertices)) - (1 << 20));
    ASSERT_TRUE(all_but_few);
    EXPECT_FALSE(reserve_arena_range(ArenaKind::vertices, 1 << 20 | 1));
}

TEST(GeometryArena, ReturnedMemoryIsZero) {
    float* base = attribute_base<float>(attribute);
    ASSERT_TRUE(base);
    ArenaRangePtr numbers = reserve_arena_range(ArenaKind::vertices, 3000);
    const int64_t first = numbers->first();
    EXPECT_EQ(base[first], 0) << "read before it is written";
    std::fill_n(base + first, 3000, 7.f);
    numbers.reset();
    EXPECT_TRUE(std::all_of(base + first, base + first + 3000, [](float f) { return f == 0; }));
}

TEST(GeometryArena, TheLastElementHasAnAddress) {
    const auto last = arena_capacity(ArenaKind::vertices) - 1;
    EXPECT_EQ(attribute_base<float>(attribute)[last], 0);
    EXPECT_EQ(index_base()[arena_capacity(ArenaKind::indices) - 1], 0u);
}

TEST(GeometryArena, VectorsUseTheArenaOnlyForTheReservedSize) {
    const ArenaRangePtr numbers = reserve_arena_range(ArenaKind::vertices, 100);
    float* place = attribute_base<float>(attribute) + numbers->first();
    Floats placed{PlacedAllocator<float>(place, 100)};
    placed.reserve(100);
    placed.resize(100);
    std::iota(placed.begin(), placed.end(), 1.f);
    EXPECT_EQ(placed.data(), place);

    const Floats copy = placed;
    EXPECT_NE(copy.data(), place) << "a copy is on the heap";
    EXPECT_EQ(copy, placed);

    Floats moved = std::move(placed);
    EXPECT_EQ(moved.data(), place);
    Floats assigned;
    assigned = std::move(moved);
    EXPECT_EQ(assigned.data(), place);

    assigned.push_back(0);
    EXPECT_NE(assigned.data(), place) << "a vector that grows moves to the heap";
    assigned.pop_back();
    EXPECT_EQ(assigned, copy);
}

#ifndef BLUSH_SANITIZED // which need more address space themselves
TEST(GeometryArenaDeathTest, NoRangesWithoutAddressSpace) {
    GTEST_FLAG_SET(death_test_style, "threadsafe"); // a separate process without reserved addresses
    const auto with_few_addresses = [] {
        rlimit few{};
        few.rlim_cur = few.rlim_max = rlim_t(1) << 30;
        setrlimit(RLIMIT_AS, &few);
        const bool taken = reserve_arena_range(ArenaKind::vertices, 1) || reserve_arena_range(ArenaKind::indices, 1);
        std::exit(taken || attribute_base<float>(attribute) ? 1 : 0);
    };
    EXPECT_EXIT(with_few_addresses(), testing::ExitedWithCode(0), "");
}
#endif

} // namespace
} // namespace blush::TEST_FILE
