// How the meshes of area lights are named in an expanded scene (expand_area_lights.h).
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace blush {

// Set in ids made by expansion; without this bit they are the id of the light's node.
constexpr uint32_t expanded_id_bit = 0x80000000u;

// True for light types that are expanded into a mesh.
bool is_area_light(const Light& light);
// True for the node of an area light's mesh.
inline bool is_expanded(Id<Node> id) { return (id.value & expanded_id_bit) != 0; }
// Nodes that carry a light, visible or not, in id order.
std::vector<Id<Node>> nodes_with_lights(const Scene& scene);
// The light whose mesh a node of the expanded scene is; nullptr: an ordinary node.
const Light* light_of_expanded_mesh(const Scene& expanded, Id<Node> node);
// True for the mesh of a disabled light, which no ray hits. With a light mix it is an ordinary black mesh, because the images of the
// other lights must not depend on which lights are enabled.
bool is_disabled_mesh(const Scene& expanded, Id<Node> node);

} // namespace blush
