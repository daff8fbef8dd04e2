// How much memory this process may have, by all limits that end it or refuse it memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace blush {

struct MemoryRoom {
    uint64_t limit = 0;        // bytes: the smallest limit
    std::string_view limit_of; // whose that is: "of this machine", "by ulimit -v", "of its control group"
    uint64_t left = 0;         // bytes that every limit still leaves
    // "3.2 GB are left, the limit is 4.0 GB of its control group"
    std::string text() const;
};

// By physical memory (MemTotal, MemAvailable), RLIMIT_AS against the address space in use, and the memory limits of the process's
// control groups, v1 and v2, up to their root (page cache that can be dropped counts as free). Reads a few small files: some 50 us.
// `root`: where /proc and /sys are, for tests.
MemoryRoom memory_room(const std::filesystem::path& root = "/");

} // namespace blush
