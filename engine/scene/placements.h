// Where the nodes of a scene are and whether they show, for whoever asks about many of them.
#pragma once

#include "scene/scene.h"

#include <unordered_map>

namespace blush {

struct Placement {
    Affined world_from_node;
    bool visible = false; // the node and all its ancestors
};

// Remembers what it has multiplied, so that asking for every node of a chain is as cheap as asking for its end. The scene must
// outlive it.
class Placements {
public:
    explicit Placements(const Scene& scene) : scene_(scene) {}
    // What world_from_node and is_visible say, bit for bit. Valid until the object goes.
    const Placement& operator()(Id<Node> node);

private:
    const Scene& scene_;
    std::unordered_map<uint32_t, Placement> known_;
};

} // namespace blush
