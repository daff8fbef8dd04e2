// Cache of world transforms and visibility of nodes, for queries of many nodes.
#pragma once

#include "scene/scene.h"

#include <unordered_map>

namespace blush {

struct NodeTransform {
    Affined world_from_node;
    bool visible = false; // the node and all its ancestors
};

// Caches the transforms of ancestors: querying all nodes of a chain costs O(length). The scene must outlive the cache.
class WorldTransforms {
public:
    explicit WorldTransforms(const Scene& scene) : scene_(scene) {}
    // Bit-identical to world_from_node and is_visible. The reference is valid for the lifetime of the cache.
    const NodeTransform& operator()(Id<Node> node);

private:
    const Scene& scene_;
    std::unordered_map<uint32_t, NodeTransform> known_;
};

} // namespace blush
