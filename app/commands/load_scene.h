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

// Errors name the file.
Result<LoadedScene> load_scene(const std::filesystem::path& file, const SceneOverrides& overrides, float aspect, Progress& progress,
                               const std::atomic<bool>& interrupted);

} // namespace blush
