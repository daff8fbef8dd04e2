#include "render/compile/expanded_lights.h"

namespace blush {

bool is_area_light(const Light& light) { return light.kind == Light::Kind::rectangle || light.kind == Light::Kind::disk; }

std::vector<Id<Node>> nodes_with_lights(const Scene& scene) {
    std::vector<Id<Node>> nodes;
    for (const auto& [id, node] : scene.nodes)
        if (node.light && scene.lights.contains(node.light)) nodes.push_back(id);
    return nodes;
}

const Light* light_of_expanded_mesh(const Scene& expanded, Id<Node> id) {
    const Node* node = is_expanded(id) ? expanded.nodes.find(Id<Node>{id.value & ~expanded_id_bit}) : nullptr;
    return node ? expanded.lights.find(node->light) : nullptr;
}

bool is_disabled_mesh(const Scene& expanded, Id<Node> id) {
    const Light* light = light_of_expanded_mesh(expanded, id);
    return light && !light->enabled && expanded.mix.grouping == LightMix::Grouping::none;
}

} // namespace blush
