#include "render/compile/expanded_lights.h"

namespace blush {

bool is_area_light(const Light& light) { return light.kind == Light::Kind::rectangle || light.kind == Light::Kind::disk; }

const Light* light_of_expanded_mesh(const Scene& expanded, Id<Node> id) {
    const Node* node = id.value & expanded_id_bit ? expanded.nodes.find(Id<Node>{id.value & ~expanded_id_bit}) : nullptr;
    return node ? expanded.lights.find(node->light) : nullptr;
}

} // namespace blush
