// The edits that add and remove whole branches of the node tree.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace blush {

// The node and all below it, parents before children. Empty if there is no such node.
std::vector<Id<Node>> subtree(const Scene& scene, Id<Node> root);
// Lights and cameras are copied, so that the copy can be changed alone; meshes are shared. The copy hangs beside the original.
void duplicate_subtree(Scene& scene, Id<Node> root);
void remove_subtree(Scene& scene, Id<Node> root);
// Adds every record of `other` under fresh ids. Ids that `other` does not hold come out as none.
void merge(Scene& scene, const Scene& other);

} // namespace blush
