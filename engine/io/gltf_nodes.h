// Internal to gltf_*.cpp: the node hierarchy of one glTF scene. Nothing here recurses: a chain of nodes may be as long as
// the file is large.
#pragma once

#include "io/gltf_source.h"

#include <vector>

namespace blush {

// Indices of the nodes of the default scene (or the first, or, if the file has no scenes, all), every parent before its
// children. Errors: an index out of range, a node with two parents, a cycle.
Result<std::vector<int>> reachable_nodes(const GltfContext& context);

// Ids of what nodes refer to, by glTF index.
struct NodeTargets {
    std::vector<Id<Mesh>> meshes;
    std::vector<Id<Light>> lights;
    std::vector<Id<Camera>> cameras;
};

// Adds the nodes, in the order given. Errors: a transform that is not finite or has the wrong number of elements, an index
// out of range.
Result<void> import_nodes(const GltfContext& context, const std::vector<int>& nodes, const NodeTargets& targets, Scene& scene);

// The glTF scene that is shown, or null.
const tinygltf::Scene* default_scene(const GltfContext& context);

} // namespace blush
