// Who names whom: every id in a scene is none or names a record that is there, and nodes form a forest.
#pragma once

#include "core/result.h"
#include "scene/scene.h"

namespace blush {

// Errors name the record that holds a stale id and what the id should have named.
Result<void> check_references(const Scene& scene, const Node& node);
Result<void> check_references(const Scene& scene, const Mesh& mesh);
Result<void> check_references(const Scene& scene, const Material& material);

// `node` is `ancestor` or hangs somewhere below it. Ends on a cycle, too.
bool is_below(const Scene& scene, Id<Node> node, Id<Node> ancestor);

} // namespace blush
