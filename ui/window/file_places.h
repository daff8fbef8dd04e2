// The folders in the file browser's list of places.
#pragma once

#include "ui/window/window_settings.h"

#include <filesystem>
#include <string>
#include <vector>

namespace blush {

struct FilePlace {
    std::string name;
    std::filesystem::path folder;
    bool bookmark = false; // added by the user, who can remove it
};

// Home, desktop, the scene's folder, folders of recent files, and bookmarks; without duplicates, only existing folders.
std::vector<FilePlace> file_places(const WindowSettings& settings, const std::filesystem::path& scene_folder);

} // namespace blush
