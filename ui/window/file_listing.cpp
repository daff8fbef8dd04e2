#include "ui/window/file_listing.h"

#include "core/files.h"

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
const ExtensionFilter lesson_files{".md"};
const ExtensionFilter image_files{".png", ".jpg", ".jpeg", ".webp", ".bmp", ".exr", ".hdr"};

bool matches(const ExtensionFilter& filter, const std::filesystem::path& file) {
    return std::ranges::find(filter, lower(file.extension().string())) != filter.end();
}

Result<FolderListing> list_folder(const std::filesystem::path& folder, const ExtensionFilter& filter) {
    std::error_code error;
    std::filesystem::directory_iterator entries(folder, std::filesystem::directory_options::skip_permission_denied, error);
    if (error) return Error{folder.string(), "cannot read the folder: " + error.message(), ""};
    FolderListing listing;
    std::vector<FileEntry>& list = listing.entries;
    for (const std::filesystem::directory_iterator end; entries != end; entries.increment(error)) {
        if (error) break;
        FileEntry entry;
        entry.name = entries->path().filename().string();
        if (entry.name.starts_with('.')) continue;
        std::error_code unreadable; // a dangling symlink is neither a folder nor a file
        entry.folder = entries->is_directory(unreadable);
        if (!entry.folder && !entries->is_regular_file(unreadable)) continue;
        if (!entry.folder && !matches(filter, entries->path())) {
            ++listing.left_out;
            continue;
        }
        if (!entry.folder) {
            const uintmax_t bytes = entries->file_size(unreadable);
            entry.bytes = unreadable ? 0 : bytes;
        }
        list.push_back(std::move(entry));
    }
    std::ranges::sort(list, [](const FileEntry& a, const FileEntry& b) {
        return std::tuple(!a.folder, lower(a.name), a.name) < std::tuple(!b.folder, lower(b.name), b.name);
    });
    return listing;
}

std::filesystem::path absolute_path(const std::string& typed, const std::filesystem::path& folder) {
    const std::filesystem::path home = user_folder("HOME", "");
    if (!home.empty() && (typed == "~" || typed.starts_with("~/")))
        return (home / typed.substr(std::min<size_t>(typed.size(), 2))).lexically_normal();
    return (folder / typed).lexically_normal();
}

std::string completed_path(const std::string& typed, const ExtensionFilter& filter) {
    const size_t slash = typed.rfind('/');
    if (slash == typed.npos) return typed;
    const std::string folder = typed.substr(0, slash + 1), begun = typed.substr(slash + 1);
    const auto listing = list_folder(folder, filter);
    if (!listing) return typed;
    std::string common;
    size_t fitting = 0;
    bool only_folders = true;
    for (const FileEntry& entry : listing->entries) {
        if (!entry.name.starts_with(begun)) continue;
        if (fitting++ == 0) common = entry.name;
        common.resize(size_t(std::ranges::mismatch(common, entry.name).in1 - common.begin()));
        only_folders &= entry.folder;
    }
    if (fitting == 0) return typed;
    return folder + common + (fitting == 1 && only_folders ? "/" : "");
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
