// Scene selection: chooses clip and time, scene, and material variant among those of a file.
#pragma once

#include "core/result.h"
#include "scene/scene.h"

#include <string>

namespace blush {

// Errors: a clip, scene or variant that does not exist, a time that is negative or not finite.
Result<void> check_scene_selection(const Scene& scene, const SceneSelection& scene_selection);

// The scene with another selection, which check_scene_selection must accept. Assigns the materials of the variant; a view through a
// camera follows the camera.
Scene with_scene_selection(const Scene& scene, const SceneSelection& scene_selection);
// Label of the undo step: "Choose variant Blue", "Change time", ...
std::string scene_selection_label(const Scene& scene, const SceneSelection& scene_selection);

// Assigns a material to a part: to the chosen variant if the part has a material for it, else as the default of all variants.
void assign_material(const Scene& scene, MeshPart& part, Id<Material> material);

} // namespace blush
