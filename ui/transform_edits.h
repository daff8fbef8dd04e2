// What a transform of the selection does to the document: which nodes it takes, and the edits it amounts to. Pure.
#pragma once

#include "scene/edit.h"
#include "ui/transform_tool.h"

#include <span>
#include <vector>

namespace blush {

// A node that is transformed, as it was when that began.
struct TransformTarget {
    Id<Node> node;
    Affined world_from_node;
    Id<Light> light; // whose size scaling changes, in place of the node's scale; none: a node with a mesh or children
    Light light_before;
};
// Of a selection: what hangs below none of the others, is led by no clip and hangs on no skin.
std::vector<TransformTarget> transform_targets(const Scene& scene, std::span<const Id<Node>> selection);

// Does the mode change the picture, or where its nodes are? Else the reason, as a sentence for the user: a point light looks the same from all sides.
std::string why_not(const Scene& scene, std::span<const TransformTarget> targets, TransformMode mode);
// Scaling along one axis alone changes something; otherwise all axes have one factor.
bool scales_along_axes(std::span<const TransformTarget> targets);

// Edits that bring the targets from where they were to where the motion has them. Nodes keep their local axes: a factor along an axis of the
// world stretches each local axis as far as it points that way, as in Blender, and no shear comes about.
std::vector<Edit> transform_edits(const Scene& scene, std::span<const TransformTarget> targets, const Motion& motion);
// "Move node Cup", "Rotate 3 objects".
std::string transform_label(const Scene& scene, std::span<const TransformTarget> targets, TransformMode mode);

// Where a node's handles sit: the middle of its mesh, else its origin. Looks at every vertex of the mesh.
Vec3d handle_point(const Scene& scene, Id<Node> node);
// Unit vectors of a node's axes in the world, scale and shear taken out; the world's for a node that is not there.
std::array<Vec3d, 3> local_axes(const Scene& scene, Id<Node> node);

} // namespace blush
