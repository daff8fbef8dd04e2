// Gathers through pointers read nothing but the words of active lanes, for each instruction set that this processor has.
#include "core/isa.h"
#include "tests/core/lane_pointers_check.h"

#include <gtest/gtest.h>

#include <array>

namespace blush::test {

bool lane_pointers_v3(const char* words, const void* unreadable);
bool lane_pointers_v4(const char* words, const void* unreadable);

namespace {

TEST(LanePointers, ReadOnlyActiveLanes) {
    std::array<char, 65> bytes{}; // the words are not aligned
    for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = char(17 * i + 3);
    const void* unreadable = reinterpret_cast<const void*>(uintptr_t(64)); // in the first page, which no process may read
    EXPECT_TRUE(reads_only_active_lanes<float>(&bytes[1], unreadable));
    EXPECT_TRUE(reads_only_active_lanes<Wide>(&bytes[1], unreadable));
    EXPECT_TRUE(!__builtin_cpu_supports("avx2") || lane_pointers_v3(&bytes[1], unreadable));
    EXPECT_TRUE(!__builtin_cpu_supports("avx512f") || lane_pointers_v4(&bytes[1], unreadable));
}

} // namespace
} // namespace blush::test
