// Memory limit of this process: the smallest of physical memory, ulimit and control groups.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace blush {

struct MemoryLimit {
    uint64_t limit = 0;        // bytes: the smallest limit
    std::string_view limit_of; // its source: "of this machine", "by ulimit -v", "of its control group"
    uint64_t left = 0;         // bytes available within all limits

    // True if the smallest limit is that of address space, which libraries and threads take more of than of memory.
    bool is_of_address_space() const;
    // "3.2 GB are left, the limit is 4.0 GB of its control group"
    std::string text() const;
};

// From physical memory (MemTotal, MemAvailable), RLIMIT_AS minus the address space in use, and the memory limits of the process's
// control groups (v1 and v2) up to the root; reclaimable page cache counts as free. Reads a few small files: about 50 us. `root`:
// parent of /proc and /sys, for tests.
MemoryLimit memory_limit(const std::filesystem::path& root = "/");

} // namespace blush
