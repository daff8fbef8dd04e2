// Internal to io/gltf: imports the node hierarchy. Uses no recursion, since a hostile file may have very deep hierarchies.
#pragma once

#include "io/gltf/read/context.h"
#include "io/gltf/read/lights/lights.h"

#include <optional>
#include <vector>

namespace blush {

// Indices of the nodes of all scenes (all nodes if the file has no scenes), ordered by scene, each once, parents before children,
// without light fallbacks (extras.h). Errors: an index out of range, a node with two parents, a cycle.
Result<std::vector<int>> reachable_nodes(const GltfContext& context);

// Ids of the records that nodes reference, by glTF index.
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

// Index of the default glTF scene; none if there are no scenes.
std::optional<size_t> default_scene(const GltfContext& context);

} // namespace blush
