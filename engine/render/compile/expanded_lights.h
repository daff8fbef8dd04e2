// How the meshes of area lights are named in an expanded scene (expand_area_lights.h).
#pragma once

#include "scene/scene.h"

#include <cstdint>

namespace blush {

// Set in ids made by expansion; without this bit they are the id of the light's node.
constexpr uint32_t expanded_id_bit = 0x80000000u;

// True for light types that are expanded into a mesh.
bool is_area_light(const Light& light);
// The light whose mesh a node of the expanded scene is; nullptr: an ordinary node.
const Light* light_of_expanded_mesh(const Scene& expanded, Id<Node> node);

} // namespace blush
