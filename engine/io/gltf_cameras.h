// Internal to gltf_*.cpp: cameras, and the view that the picture is first taken from.
#pragma once

#include "io/gltf_source.h"

#include <vector>

namespace blush {

// Adds the file's cameras; result[i] is the id of glTF camera i. extras.blush of a camera may hold aperture_radius and
// focus_distance, both in metres. Values that make no projection are replaced with a warning.
std::vector<Id<Camera>> import_cameras(const GltfContext& context, Scene& scene);

// Through the first camera node, or, without one, from a three-quarter angle with everything in the picture.
View initial_view(const Scene& scene);

// Sets the view that extras.blush.view of a glTF scene holds; false if it holds none that makes sense.
bool import_view(const GltfContext& context, const nlohmann::json& gltf_scene, const std::string& where, View& view);

} // namespace blush
