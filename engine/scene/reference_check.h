// Reference check: every id in a scene is none or names an existing record, and nodes form a forest.
#pragma once

#include "core/result.h"
#include "scene/scene.h"

namespace blush {

// Errors name the record with the dangling id and the kind of record that it should reference.
Result<void> check_references(const Scene& scene, const Node& node);
Result<void> check_references(const Scene& scene, const Mesh& mesh);
Result<void> check_references(const Scene& scene, const Material& material);

// True if `node` is `ancestor` or a descendant of it. Terminates on a cycle.
bool is_below(const Scene& scene, Id<Node> node, Id<Node> ancestor);

} // namespace blush
