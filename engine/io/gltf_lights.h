// Internal to gltf_*.cpp: KHR_lights_punctual, and what extras.blush adds to it.
#pragma once

#include "io/gltf_source.h"

#include <vector>

namespace blush {

// Adds the file's lights to the scene; result[i] is the id of KHR_lights_punctual light i, none for an unknown type.
std::vector<Id<Light>> import_lights(const GltfContext& context, Scene& scene);

// extras.blush.environment of a glTF scene; no environment without it. A map that cannot be read is a warning and leaves
// a constant of the same colour. Errors: its path leaves the scene's folder.
Result<Environment> import_environment(const GltfContext& context, const tinygltf::Scene& gltf_scene, const std::string& where);

} // namespace blush
