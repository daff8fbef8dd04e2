// Meshes as morph targets and joints bend them: glTF 2.0, 3.7.2.2 and 3.7.3.3.
#pragma once

#include "scene/placements.h"
#include "scene/scene.h"

#include <optional>
#include <vector>

namespace blush {

// How a node's mesh is bent: equal bends of one geometry give the same. Positions come out about `origin`, along the world's axes, if the
// mesh hangs on a skin; else where the node is, in its own frame.
struct Bend {
    std::vector<float> weights;  // of morph targets
    std::vector<Affined> joints; // per joint, the frame that positions come out in from that of the mesh; empty: no skin
    Affined rigid;               // the same for vertices that no joint carries
    Vec3d origin{0, 0, 0};       // of the skin's first joint, in the world
    bool operator==(const Bend&) const = default;
};

// None if the node's mesh is as it is.
std::optional<Bend> bend_of(const Scene& scene, Placements& placements, Id<Node> id, const Node& node);
// Vertices whose place would not be finite stay at rest.
GeometryPtr bent(const Geometry& geometry, const Bend& bend);

// Where a mesh that is bent like this is.
inline Affined world_from_bent(const Bend& bend, const Affined& world_from_node) {
    return bend.joints.empty() ? world_from_node : Affined{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, bend.origin};
}

// A node's mesh as and where it is. No parts: it has none.
struct PlacedMesh {
    std::vector<MeshPart> parts;
    Affined world_from_mesh;
};
PlacedMesh placed_mesh(const Scene& scene, Placements& placements, Id<Node> id, const Node& node);

} // namespace blush
