// Applies a transform of the selection to the document: which nodes are transformed, and the resulting edits. Pure.
#pragma once

#include "scene/document/edit.h"
#include "ui/transform/transform_tool.h"

#include <span>
#include <vector>

namespace blush {

// A transformed node, with its state at the start.
struct TransformTarget {
    Id<Node> node;
    Affined world_from_node;
    Id<Light> light; // its size is scaled instead of the node; null id: a node with a mesh or children
    Light light_before;
};
// The nodes of a selection that can be transformed: not a descendant of another selected node, not animated, not skinned.
std::vector<TransformTarget> transform_targets(const Scene& scene, std::span<const Id<Node>> selection);

// Why the mode has no effect, as a sentence for the user; empty if it has one. A point light, for example, looks the same from
// all sides.
std::string why_not(const Scene& scene, std::span<const TransformTarget> targets, TransformMode mode);
// True if scaling along a single axis is possible; otherwise scaling is uniform.
bool scales_along_axes(std::span<const TransformTarget> targets);

// Edits that move the targets from their initial transforms by the motion. A scale factor along a world axis is distributed to
// the local axes by their direction, as in Blender, so no shear results.
std::vector<Edit> transform_edits(const Scene& scene, std::span<const TransformTarget> targets, const Motion& motion);
// "Move node Cup", "Rotate 3 objects".
std::string transform_label(const Scene& scene, std::span<const TransformTarget> targets, TransformMode mode);

// The pivot of a node's handles: the centre of its mesh, else its origin. Reads every vertex of the mesh.
Vec3d handle_point(const Scene& scene, Id<Node> node);
// World axes of a node as unit vectors, without scale and shear; the standard axes for a missing node.
std::array<Vec3d, 3> local_axes(const Scene& scene, Id<Node> node);

} // namespace blush
