// Mesh deformation: morphing and skinning (glTF 2.0, 3.7.2.2 and 3.7.3.3).
#pragma once

#include "scene/scene.h"
#include "scene/world_transforms.h"

#include <optional>
#include <vector>

namespace blush {

class Workers;

// Deformation of a node's mesh: morph target weights and joint matrices. Equal values deform one geometry to equal vertices.
// Deformed positions of a skinned mesh are relative to `origin`, along the world axes; of a mesh without skin they are in the
// node's space.
struct Deformation {
    std::vector<float> weights;  // of morph targets
    std::vector<Affined> joints; // per joint, deformed space from mesh space; empty: no skin
    Affined rigid;               // the same for vertices without influences
    Vec3d origin{0, 0, 0};       // world position of the skin's first joint
    bool operator==(const Deformation&) const = default;
};

// Deformation of the node's mesh; none if the mesh is not deformed.
std::optional<Deformation> deformation_of(const Scene& scene, WorldTransforms& transforms, Id<Node> id, const Node& node);
// The deformed geometry. A vertex whose deformed position is not finite keeps its rest position. `workers` share the vertices, which do
// not depend on each other: the result is the same for any number of threads. Null: single-threaded.
GeometryPtr deformed(const Geometry& geometry, const Deformation& deformation, const Workers* workers = nullptr);

// World transform of a mesh after this deformation.
inline Affined world_from_deformed(const Deformation& deformation, const Affined& world_from_node) {
    return deformation.joints.empty() ? world_from_node : Affined{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, deformation.origin};
}

// A node's deformed mesh and its world transform. No parts if the node has no mesh.
struct DeformedMesh {
    std::vector<MeshPart> parts;
    Affined world_from_mesh;
};
DeformedMesh deformed_mesh(const Scene& scene, WorldTransforms& transforms, Id<Node> id, const Node& node);

} // namespace blush
