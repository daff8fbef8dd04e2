// Internal to io/gltf: imports cameras and the initial view.
#pragma once

#include "io/gltf/read/context.h"

#include <vector>

namespace blush {

// Adds the file's cameras; result[i] is the id of glTF camera i. extras.blush of a camera may hold aperture_radius and
// focus_distance, both in metres. Invalid projection parameters are replaced with a warning.
std::vector<Id<Camera>> import_cameras(const GltfContext& context, Scene& scene);

// View through the first camera node; without one, a three-quarter view that frames the whole scene.
View initial_view(const Scene& scene);

// Sets the view from extras.blush.view of a glTF scene; false if it has no valid one.
bool import_view(const GltfContext& context, const nlohmann::json& gltf_scene, const std::string& where, View& view);

} // namespace blush
