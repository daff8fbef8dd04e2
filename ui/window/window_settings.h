// UI settings saved between starts, in $XDG_CONFIG_HOME/blush/window.json, independent of scenes.
#pragma once

#include "core/result.h"
#include "ui/window/dock.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace blush {

// A plan of a scene (ui/views/farm_view.h).
struct PlanMemory {
    std::string folder;
    int64_t in_strip = 0; // samples of the merged images that the strip has shown
    bool operator==(const PlanMemory&) const = default;
};

// UI state of the last session with a scene file.
struct SceneMemory {
    std::string file;
    double zoom = 0, u = 0.5, v = 0.5;    // ImageZoom
    std::vector<uint32_t> selected;       // Id<Node>.value, the active one first
    uint32_t material = 0;                // Id<Material>.value of the selected material
    std::vector<uint32_t> turned;         // Id<Node>.value of the outliner rows whose fold state differs from the default
    std::string mix_group;                // the light mix group whose colour settings are shown
    std::vector<std::string> snapshots;   // files, oldest first
    std::vector<std::string> instruments; // ids of the open ones
    std::vector<PlanMemory> plans;        // oldest first
    bool operator==(const SceneMemory&) const = default;
};
constexpr size_t remembered_files = 10;
constexpr int min_text_size = 80, max_text_size = 200; // per cent

struct WindowSettings {
    int width = 1280, height = 800; // of the window, in screen coordinates
    bool maximized = false;
    Splitters splitters;
    Dock dock;                            // layout of the instruments
    int text_size = 100;                  // per cent of the display's default
    bool follow_viewport = true;          // render at the viewport's size
    bool overlays = true;                 // light glyphs, handles, outlines
    std::vector<std::string> recent;      // scene files, newest first
    std::string snapshot_folder;          // empty: that of the scene
    bool snapshot_files = true;           // every snapshot is written to a file,
    bool snapshot_half = false;           // with colours in 16 bits,
    bool snapshot_film = true;            // with samples, to resume rendering
    int64_t snapshot_memory = 2048;       // MiB limit for the strip's snapshots; above it the oldest are unloaded
    std::vector<std::string> bookmarks;   // folders of the file browser
    bool desktop_file_dialog = true;      // use the desktop's file dialog, if available
    std::string browser_folder;           // last folder of the file browser
    std::map<std::string, double> panels; // open panels and their settings (ui_persistence.h), and sections of the inspector
    std::string floating;                 // ImGui's text with the positions of floating windows
    std::vector<SceneMemory> scenes;      // newest first
    bool operator==(const WindowSettings&) const = default;
};

// $XDG_CONFIG_HOME/blush/window.json, or ~/.config/blush/window.json; empty if neither variable is set.
std::filesystem::path window_settings_file();

// Returns the defaults for a missing or damaged file, or for damaged entries.
WindowSettings read_window_settings(const std::filesystem::path& file);
// Creates the folder; writes a temporary file and renames it, so that the file is never incomplete.
Result<void> write_window_settings(const std::filesystem::path& file, const WindowSettings& settings);

// Moves a file to the front of the recent list, which keeps the ten newest.
void remember_recent(std::vector<std::string>& recent, const std::string& file);

} // namespace blush
