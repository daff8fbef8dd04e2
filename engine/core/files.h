// Whole files in and out. Reading refuses what is not a plain file or is too large; writing is all or nothing.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace blush {

// Errors: not there, not a regular file (devices and pipes may never end), larger than max_bytes, unreadable.
Result<std::vector<uint8_t>> read_file(const std::filesystem::path& file, uint64_t max_bytes);

// Writes to a temporary name beside the target, syncs, renames: whoever looks sees the old file or the new one, never a
// part. Through a symbolic link it writes the file that the link names. The temporary is removed upon failure; those that killed processes left
// behind for the same target are removed. Errors: unwritable folder, disk full, the target is not a regular file.
Result<void> write_file(const std::filesystem::path& file, std::span<const uint8_t> bytes);
Result<void> write_file(const std::filesystem::path& file, std::string_view text);

// Where the user keeps files of a kind: the folder that the environment variable (XDG_CONFIG_HOME, XDG_CACHE_HOME, XDG_STATE_HOME) names, or
// else `below_home` in $HOME. As the XDG base directory specification wants, relative names do not count. Empty if neither is known.
std::filesystem::path user_folder(const char* variable, const char* below_home);

} // namespace blush
