// Edits of subtrees of the node tree: duplicate, remove, merge.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace blush {

// The node and its descendants, parents before children. Empty if there is no such node.
std::vector<Id<Node>> subtree(const Scene& scene, Id<Node> root);
// Duplicates a node and its descendants as a sibling. Lights and cameras are copied, so that the duplicate can be edited on its
// own; meshes are shared.
void duplicate_subtree(Scene& scene, Id<Node> root);
void remove_subtree(Scene& scene, Id<Node> root);
// Adds every record of `other` with new ids. Ids that do not exist in `other` become none.
void merge(Scene& scene, const Scene& other);

} // namespace blush
