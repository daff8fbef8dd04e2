#include "scene/node_name.h"

#include <fmt/format.h>

namespace blush {

const char* kind_name(Light::Kind kind) {
    switch (kind) {
    case Light::Kind::point: return "Point";
    case Light::Kind::spot: return "Spot";
    case Light::Kind::sun: return "Sun";
    case Light::Kind::rectangle: return "Rectangle";
    case Light::Kind::disk: return "Disk";
    case Light::Kind::sphere: return "Sphere";
    }
    return "";
}

std::string node_name(const Scene& scene, Id<Node> id, const Node& node) {
    if (!node.name.empty()) return node.name;
    if (const Light* light = scene.lights.find(node.light)) return light->name.empty() ? kind_name(light->kind) : light->name;
    if (const Mesh* mesh = scene.meshes.find(node.mesh); mesh && !mesh->name.empty()) return mesh->name;
    return fmt::format("Node {}", id.value);
}

} // namespace blush
