// Internal to gltf_*.cpp: KHR_lights_punctual, EXT_lights_area, EXT_lights_ies, and what extras.blush adds to them.
#pragma once

#include "io/gltf_measured_lights.h"

#include <vector>

namespace blush {

// Ids of the lights in the lists of the extensions, and of those with a measured distribution; none for what cannot be shown.
struct LightIds {
    std::vector<Id<Light>> punctual, area, measured;
    MeasuredLights measured_as;
};
// `nodes`: indices of those that are shown. Errors: as of read_measured_lights.
Result<LightIds> import_lights(const GltfContext& context, const std::vector<int>& nodes, Scene& scene);
// Where each of them is.
void index_lights(const LightIds& ids, GltfIndices& indices);

// The environment as extras.blush.environment of a glTF scene changes it. Where it is an image without a file its pixels stay. A map that
// cannot be read is a warning and leaves a constant of the same colour. Errors: its path leaves the scene's folder.
Result<Environment> import_environment(const GltfContext& context, const nlohmann::json& gltf_scene, const std::string& where,
                                       const Environment& otherwise);

} // namespace blush
