// Scene selection: chooses clip and time, scene, and material variant among those of a file.
#pragma once

#include "core/result.h"
#include "scene/scene.h"

#include <string>

namespace blush {

// Errors: a clip, scene or variant that does not exist, a time that is negative or not finite.
Result<void> check_staging(const Scene& scene, const Staging& staging);

// The scene with another selection, which check_staging must accept. Assigns the materials of the variant; a view through a
// camera follows the camera.
Scene staged(const Scene& scene, const Staging& staging);
// Label of the undo step: "Choose variant Blue", "Change time", ...
std::string staging_label(const Scene& scene, const Staging& staging);

// Assigns a material to a part: to the chosen variant if the part has a material for it, else as the default of all variants.
void wear(const Scene& scene, MeshPart& part, Id<Material> material);

} // namespace blush
