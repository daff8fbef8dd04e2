// Internal to io/gltf: imports lights of KHR_lights_punctual, EXT_lights_area and EXT_lights_ies with extras.blush, and the
// environment.
#pragma once

#include "io/gltf/read/lights/ies_lights.h"

#include <vector>

namespace blush {

// Ids of the lights in the lists of the extensions; none for lights that are not supported.
struct LightIds {
    std::vector<Id<Light>> punctual, area, measured;
    IesLights ies_lights;
};
// `nodes`: indices of all nodes in scenes. Errors: as of read_ies_lights.
Result<LightIds> import_lights(const GltfContext& context, const std::vector<int>& nodes, Scene& scene);
// Records the list and index of each light.
void index_lights(const LightIds& ids, GltfIndices& indices);

// `otherwise` with the changes of extras.blush.environment of a glTF scene. An image without a file keeps its pixels. A map that
// cannot be read is a warning and becomes a constant environment of the same colour. Errors: its path leaves the scene's folder.
Result<Environment> import_environment(const GltfContext& context, const nlohmann::json& gltf_scene, const std::string& where,
                                       const Environment& otherwise);

} // namespace blush
