// Internal to gltf_*.cpp: the node hierarchy of one glTF scene. Nothing here recurses: a chain of nodes may be as long as
// the file is large.
#pragma once

#include "io/gltf_lights.h"
#include "io/gltf_source.h"

#include <optional>
#include <vector>

namespace blush {

// Indices of the nodes of all scenes (or, if the file has no scenes, all), scene by scene and each once, every parent before its
// children, without stand-ins for lights (gltf_extras.h). Errors: an index out of range, a node with two parents, a cycle.
Result<std::vector<int>> reachable_nodes(const GltfContext& context);

// Ids of what nodes refer to, by glTF index.
struct NodeTargets {
    std::vector<Id<Mesh>> meshes;
    LightIds lights;
    std::vector<Id<Camera>> cameras;
    std::vector<Id<Skin>> skins;
};

// Adds the nodes; result[i] is the id of nodes[i]. Errors: a transform that is not finite or has the wrong number of elements, an index
// out of range.
Result<std::vector<Id<Node>>> import_nodes(const GltfContext& context, const std::vector<int>& nodes, const NodeTargets& targets,
                                           Scene& scene);

// The index of the glTF scene that is shown; none if there are no scenes.
std::optional<size_t> default_scene(const GltfContext& context);

} // namespace blush
