// What the file browser shows of a folder: pure but for reading the folder.
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

// Lower-case extensions with the dot; empty: folders alone.
using ExtensionFilter = std::vector<std::string>;

// Case does not count.
bool matches(const ExtensionFilter& filter, const std::filesystem::path& file);
struct FolderListing {
    std::vector<FileEntry> entries;
    size_t left_out = 0; // files that the filter does not let through
};
// Folders first, then the files that match, each in the order of their names without regard to case. Names with a leading dot are neither
// listed nor counted.
Result<FolderListing> list_folder(const std::filesystem::path& folder, const ExtensionFilter& filter);
// A typed path as far as the names in its folder tell: up to where those that fit differ, with a slash after the only folder. The path itself if
// nothing fits.
std::string completed_path(const std::string& typed, const ExtensionFilter& filter);
// "812 B", "3.4 MB".
std::string bytes_text(uintmax_t bytes);

extern const ExtensionFilter scene_files, environment_files, table_files, snapshot_files, photometric_files, image_files;

} // namespace blush
