// Folders that the file browser offers beside its list.
#pragma once

#include "ui/window_settings.h"

#include <filesystem>
#include <string>
#include <vector>

namespace blush {

struct FilePlace {
    std::string name;
    std::filesystem::path folder;
    bool bookmark = false; // made by the user, who may take it away
};

// Home, desktop, the scene's folder, those of recent files, and bookmarks; each folder once, and only folders that are there.
std::vector<FilePlace> file_places(const WindowSettings& settings, const std::filesystem::path& scene_folder);

} // namespace blush
