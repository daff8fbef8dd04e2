// Internal to gltf_*.cpp: KHR_lights_punctual, EXT_lights_area, and what extras.blush adds to them.
#pragma once

#include "io/gltf_source.h"

#include <vector>

namespace blush {

// Ids of the lights in the lists of the two extensions; none for an unknown type.
struct LightIds {
    std::vector<Id<Light>> punctual, area;
};
LightIds import_lights(const GltfContext& context, Scene& scene);

// extras.blush.environment of a glTF scene; no environment without it. A map that cannot be read is a warning and leaves
// a constant of the same colour. Errors: its path leaves the scene's folder.
Result<Environment> import_environment(const GltfContext& context, const nlohmann::json& gltf_scene, const std::string& where);

} // namespace blush
