// The file browser's listing of a folder: pure except for reading the folder.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace blush {

struct FileEntry {
    std::string name;
    bool folder = false;
    uintmax_t bytes = 0;
    bool operator==(const FileEntry&) const = default;
};

// Lower-case extensions with the dot; empty: only folders.
using ExtensionFilter = std::vector<std::string>;

// Case-insensitive.
bool matches(const ExtensionFilter& filter, const std::filesystem::path& file);
struct FolderListing {
    std::vector<FileEntry> entries;
    size_t left_out = 0; // number of files that the filter excludes
};
// Folders first, then matching files, each sorted by name, case-insensitive. Hidden files (leading dot) are neither listed nor
// counted.
Result<FolderListing> list_folder(const std::filesystem::path& folder, const ExtensionFilter& filter);
// The path that a user means: "~/x" is in the home folder, a relative path in `folder`.
std::filesystem::path absolute_path(const std::string& typed, const std::filesystem::path& folder);
// Tab completion of a typed path: the longest common prefix of the matching names in its folder, with a slash after a unique
// folder. The path itself if nothing matches.
std::string completed_path(const std::string& typed, const ExtensionFilter& filter);
// "812 B", "3.4 MB".
std::string bytes_text(uintmax_t bytes);

extern const ExtensionFilter scene_files, environment_files, table_files, snapshot_files, photometric_files, image_files, lesson_files;

} // namespace blush
