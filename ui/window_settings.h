// What the window remembers from one start to the next. Kept in $XDG_CONFIG_HOME/blush/window.json, apart from any scene.
#pragma once

#include "core/result.h"
#include "ui/dock.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace blush {

// How the scene of a file was last looked at.
struct SceneMemory {
    std::string file;
    double zoom = 0, u = 0.5, v = 0.5; // PictureZoom
    std::vector<uint32_t> selected;    // Id<Node>.value, the first to come first
    uint32_t material = 0;             // Id<Material>.value of the one selected
    std::vector<uint32_t> turned;      // Id<Node>.value of the outliner's rows that are not folded as they are at first
    std::string mix_group;             // whose colour the light mix shows
    std::vector<std::string> snapshots; // files, oldest first
    std::vector<std::string> instruments; // ids of those that were open
    bool operator==(const SceneMemory&) const = default;
};
constexpr size_t remembered_files = 10;
constexpr int least_text_size = 80, most_text_size = 200; // per cent

struct WindowSettings {
    int width = 1280, height = 800; // of the window, in screen coordinates
    bool maximized = false;
    Splitters splitters;
    Dock dock;                       // of the instruments
    int text_size = 100;             // per cent of what the display asks for
    bool follow_viewport = true;     // render at the viewport's size
    bool overlays = true;            // light glyphs, handles, outlines
    std::vector<std::string> recent; // scene files, newest first
    std::string snapshot_folder;     // empty: that of the scene
    bool snapshot_files = true;      // each snapshot is written to a file,
    bool snapshot_half = false;      // its colours in 16 bits,
    bool snapshot_film = true;       // with the samples to go on from
    int64_t snapshot_memory = 2048;  // MiB that the strip's snapshots may take before the oldest live in their files alone
    std::vector<std::string> bookmarks; // folders of the file browser
    bool desktop_file_dialog = true; // files are asked for by the desktop's own dialog, where there is one
    std::string browser_folder;      // where the file browser was last
    std::map<std::string, double> panels; // which are open and what they are set to (remembered.h), and sections of the inspector
    std::string floating;            // where panels lie: ImGui's text
    std::vector<SceneMemory> scenes; // newest first
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
