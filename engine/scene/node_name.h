// The name that the window shows for an object.
#pragma once

#include "scene/scene.h"

#include <string>

namespace blush {

// "Point", "Spot", "Sun", ...
const char* kind_name(Light::Kind kind);

// The name of a node; if it has none, that of its light or mesh, or the kind of its light, or "Node 3".
std::string node_name(const Scene& scene, Id<Node> id, const Node& node);

} // namespace blush
