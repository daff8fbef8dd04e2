// The allocation of adaptive sampling as a file, so that many machines render parts of one adaptive image: `blush merge
// --allocation` writes it from the pilot, `blush render --samples A:B --allocation` follows it.
#pragma once

#include "core/result.h"
#include "render/film/sample_allocation.h"

#include <filesystem>
#include <string>

namespace blush {

struct AllocationFile {
    std::string scene_hash; // scene_hash.h
    int width = 0, height = 0;
    SampleAllocation::Shares shares; // by half and tile
    bool operator==(const AllocationFile&) const = default;
};

// Of the content, 16 hexadecimal digits.
std::string allocation_hash(const AllocationFile& allocation);
// JSON with this hash. Errors: not writable.
Result<void> write_allocation(const std::filesystem::path& file, const AllocationFile& allocation);
// Errors: unreadable, not such a file, damaged (its hash differs), shares that do not fit the size.
Result<AllocationFile> read_allocation(const std::filesystem::path& file);

} // namespace blush
