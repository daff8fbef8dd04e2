// Reads and writes whole files. Reading rejects special and too large files; writing is atomic.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace blush {

// Errors: missing, not a regular file (devices and pipes may never end), larger than max_bytes, unreadable.
Result<std::vector<uint8_t>> read_file(const std::filesystem::path& file, uint64_t max_bytes);

// Writes to a temporary file beside the target, syncs and renames it: readers see the old or the new file, never a part. Follows
// symbolic links. After an error the temporary file is removed; so are temporary files of killed processes for the same target.
// Errors: unwritable folder, disk full, the target is not a regular file.
Result<void> write_file(const std::filesystem::path& file, std::span<const uint8_t> bytes);
Result<void> write_file(const std::filesystem::path& file, std::string_view text);

// XDG base directory: the folder of the environment variable (XDG_CONFIG_HOME, XDG_CACHE_HOME, XDG_STATE_HOME), or else
// `below_home` in $HOME. Relative paths are ignored, as the specification requires. Empty if neither is set.
std::filesystem::path user_folder(const char* variable, const char* below_home);
// Folder of the user, such as XDG_DESKTOP_DIR: as in the environment, or else as xdg-user-dirs has written it into user-dirs.dirs,
// or else `below_home` in $HOME.
std::filesystem::path named_user_folder(const std::string& variable, const char* below_home);

} // namespace blush
