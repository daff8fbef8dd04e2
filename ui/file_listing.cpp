#include "ui/file_listing.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {
namespace {

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

} // namespace

const ExtensionFilter scene_files{".gltf", ".glb"};
const ExtensionFilter environment_files{".hdr", ".exr"};
const ExtensionFilter table_files{".csv"};
const ExtensionFilter snapshot_files{".exr"};
const ExtensionFilter photometric_files{".ies"};

bool matches(const ExtensionFilter& filter, const std::filesystem::path& file) {
    return std::ranges::find(filter, lower(file.extension().string())) != filter.end();
}

Result<std::vector<FileEntry>> list_folder(const std::filesystem::path& folder, const ExtensionFilter& filter) {
    std::error_code error;
    std::filesystem::directory_iterator entries(folder, std::filesystem::directory_options::skip_permission_denied, error);
    if (error) return Error{folder.string(), "cannot read the folder: " + error.message(), ""};
    std::vector<FileEntry> list;
    for (const std::filesystem::directory_iterator end; entries != end; entries.increment(error)) {
        if (error) break;
        FileEntry entry;
        entry.name = entries->path().filename().string();
        if (entry.name.starts_with('.')) continue;
        std::error_code unreadable; // a dangling link is neither a folder nor a file
        entry.folder = entries->is_directory(unreadable);
        if (!entry.folder && !(entries->is_regular_file(unreadable) && matches(filter, entries->path()))) continue;
        if (!entry.folder) {
            const uintmax_t bytes = entries->file_size(unreadable);
            entry.bytes = unreadable ? 0 : bytes;
        }
        list.push_back(std::move(entry));
    }
    std::ranges::sort(list, [](const FileEntry& a, const FileEntry& b) {
        return std::tuple(!a.folder, lower(a.name), a.name) < std::tuple(!b.folder, lower(b.name), b.name);
    });
    return list;
}

std::string bytes_text(uintmax_t bytes) {
    if (bytes < 1000) return fmt::format("{} B", bytes);
    const char* const units[] = {"kB", "MB", "GB", "TB"};
    double value = double(bytes) / 1000;
    size_t unit = 0;
    for (; value >= 999.5 && unit + 1 < std::size(units); ++unit) value /= 1000;
    return fmt::format("{:.{}f} {}", value, value < 9.95 ? 1 : 0, units[unit]);
}

} // namespace blush
