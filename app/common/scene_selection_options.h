// Scene selection on the command line: animation and time, scene, material variant.
#pragma once

#include "core/result.h"
#include "scene/scene.h"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace blush {

// Names or indices from 0; a name has priority. Empty: the file's default.
struct SceneSelectionOptions {
    std::string animation = {};        // or "none"
    std::optional<float> seconds = {}; // time in this animation, or in the current one
    std::string scene = {};
    std::string variant = {}; // or "none"
    bool operator==(const SceneSelectionOptions&) const = default;
};

// Errors: unknown name, a time without an animation, an invalid time.
Result<SceneSelection> find_scene_selection(const SceneSelectionOptions& choice, const Scene& scene);

void add_scene_selection_options(CLI::App& app, SceneSelectionOptions& choice);

} // namespace blush
