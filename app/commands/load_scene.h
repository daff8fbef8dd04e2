// A scene file as the command line asked for it.
#pragma once

#include "app/scene_overrides.h"
#include "io/gltf_import.h"

#include <atomic>
#include <filesystem>

namespace blush {

class Progress;

struct LoadedScene {
    Scene imported; // as it is in the file
    Scene scene;    // with the overrides
    ImportReport report;
    // Width over height of the camera's frame: that which was saved with the scene, else that of the camera that is looked through; 0: not known.
    float camera_aspect = 0;
};

// Errors name the file.
Result<LoadedScene> load_scene(const std::filesystem::path& file, const SceneOverrides& overrides, float aspect, Progress& progress,
                               const std::atomic<bool>& interrupted);

} // namespace blush
