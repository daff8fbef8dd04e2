#include "ui/window/file_places.h"

#include "core/files.h"

#include <algorithm>

namespace blush {

std::vector<FilePlace> file_places(const WindowSettings& settings, const std::filesystem::path& scene_folder) {
    constexpr size_t max_recent_folders = 5;
    std::vector<FilePlace> places;
    const auto add = [&](std::string name, const std::filesystem::path& folder, bool bookmark = false) {
        std::error_code unreadable;
        const bool known = std::ranges::any_of(places, [&](const FilePlace& p) { return p.folder == folder; });
        if (known || folder.empty() || !std::filesystem::is_directory(folder, unreadable)) return false;
        places.push_back({std::move(name), folder, bookmark});
        return true;
    };
    const auto name_of = [](const std::filesystem::path& folder) {
        return folder.has_filename() ? folder.filename().string() : folder.string();
    };
    for (const std::string& bookmark : settings.bookmarks) add(name_of(bookmark), bookmark, true);
    add("Home", user_folder("HOME", ""));
    add("Desktop", named_user_folder("XDG_DESKTOP_DIR", "Desktop"));
    add("Scene", scene_folder);
    size_t recent = 0;
    for (const std::string& file : settings.recent) {
        const std::filesystem::path folder = std::filesystem::path(file).parent_path();
        if (recent < max_recent_folders && add(name_of(folder), folder)) ++recent;
    }
    return places;
}

} // namespace blush
