// Meshes deformed by morph targets and skinning, as they are traced.
#pragma once

#include "scene/animation/deform.h"

#include <map>
#include <vector>

namespace blush {

// Cache of the last deformed meshes, so that an unchanged deformation keeps its geometry and BVH.
class DeformedMeshes {
public:
    // Gives each node with a deformed mesh its own mesh. `posed`: a scene with its pose applied (scene/animation/pose.h). `workers` as in
    // deformed().
    void deform(Scene& posed, const Workers* workers);

private:
    struct Entry {
        std::vector<MeshPart> rest;
        Deformation deformation;
        std::vector<GeometryPtr> parts;
    };
    std::map<Id<Node>, Entry> known_;
};

// Ids of those meshes: this bit plus the id of their node.
constexpr uint32_t deformed_id_bit = 0x40000000u;

// World transform of a node's mesh in such a scene; skinned meshes are relative to their first joint (scene/animation/deform.h).
Affined world_from_mesh(const Scene& expanded, WorldTransforms& transforms, Id<Node> id, const Node& node);

} // namespace blush
