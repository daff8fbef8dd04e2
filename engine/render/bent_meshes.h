// Meshes that morph targets and joints bend, as rays meet them.
#pragma once

#include "scene/bend.h"

#include <map>
#include <vector>

namespace blush {

// What was bent last time, so that what bends the same again is the same geometry and need not be built anew.
class BentMeshes {
public:
    // Gives each node whose mesh bends a mesh of its own. `posed`: a scene with its pose applied (scene/pose.h).
    void bend(Scene& posed);

private:
    struct Entry {
        std::vector<MeshPart> rest;
        Bend bend;
        std::vector<GeometryPtr> parts;
    };
    std::map<Id<Node>, Entry> known_;
};

// Ids of those meshes: with this bit, and that of their node.
constexpr uint32_t bent_bit = 0x40000000u;

// Where the mesh of a node of such a scene is: what hangs on a skin is about its first joint (scene/bend.h).
Affined world_from_mesh(const Scene& lowered, Placements& placements, Id<Node> id, const Node& node);

} // namespace blush
