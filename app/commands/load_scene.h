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
};

// Errors name the file.
Result<LoadedScene> load_scene(const std::filesystem::path& file, const SceneOverrides& overrides, float aspect, Progress& progress,
                               const std::atomic<bool>& interrupted);

} // namespace blush
