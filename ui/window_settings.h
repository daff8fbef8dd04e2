// What the window remembers from one start to the next. Kept in $XDG_CONFIG_HOME/blush/window.json, apart from any scene.
#pragma once

#include "core/result.h"
#include "ui/layout.h"

#include <filesystem>
#include <string>
#include <vector>

namespace blush {

struct WindowSettings {
    int width = 1280, height = 800; // of the window, in screen coordinates
    bool maximized = false;
    Splitters splitters;
    bool follow_viewport = true;     // render at the viewport's size
    bool overlays = true;            // light glyphs, handles, outlines
    std::vector<std::string> recent; // scene files, newest first
    std::string snapshot_folder;     // empty: the working directory
    bool snapshot_files = true;      // each snapshot is written to a file,
    bool snapshot_half = false;      // its colours in 16 bits,
    bool snapshot_film = true;       // with the samples to go on from
    std::string browser_folder;      // where the file browser was last
    bool operator==(const WindowSettings&) const = default;
};

// $XDG_CONFIG_HOME/blush/window.json, or the same under ~/.config; empty if neither variable is set.
std::filesystem::path window_settings_file();

// A missing or damaged file, or a damaged entry of it, gives the defaults.
WindowSettings read_window_settings(const std::filesystem::path& file);
// Creates the folder; written beside the target and renamed, so that the file is whole or not there.
Result<void> write_window_settings(const std::filesystem::path& file, const WindowSettings& settings);

// Moves a file to the front of the recent list; the list keeps its ten newest.
void remember_recent(std::vector<std::string>& recent, const std::string& file);

} // namespace blush
