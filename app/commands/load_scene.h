// Loads a scene file with the options of the command line.
#pragma once

#include "app/common/scene_overrides.h"
#include "io/gltf/read/import.h"

#include <atomic>
#include <filesystem>

namespace blush {

class Progress;

struct LoadedScene {
    Scene imported; // as in the file
    Scene scene;    // with the overrides
    ImportReport report;
    // Aspect ratio (width / height) of the camera's frame: the one saved with the scene, else the camera's own; 0: unknown.
    float camera_aspect = 0;
};

// The steps of load_scene(), for several sets of overrides of one file. Errors name the file.
Result<ImportedScene> import_scene(const std::filesystem::path& file, std::optional<int64_t> texture_mib, Progress& progress,
                                   const std::atomic<bool>& interrupted);
Result<LoadedScene> overridden(ImportedScene imported, const std::filesystem::path& file, const SceneOverrides& overrides, float aspect);

// Errors name the file.
Result<LoadedScene> load_scene(const std::filesystem::path& file, const SceneOverrides& overrides, float aspect, Progress& progress,
                               const std::atomic<bool>& interrupted);

} // namespace blush
