#include "scene/world_transforms.h"

#include "core/math.h"
#include "scene/animation/pose.h"

namespace blush {

const NodeTransform& WorldTransforms::operator()(Id<Node> id) {
    struct Link {
        uint32_t id;
        const Node* node;
    };
    std::vector<Link> unknown; // from the node up to a cached ancestor or the root
    const NodeTransform* above = nullptr;
    while (const Node* node = scene_.nodes.find(id)) {
        if (const auto found = known_.find(id.value); found != known_.end()) {
            above = &found->second;
            break;
        }
        if (unknown.size() == scene_.nodes.size()) break; // a cycle
        unknown.push_back({id.value, node});
        id = node->parent;
    }
    // Always multiplied from the root down, so that cached and uncached products are bit-identical.
    for (auto link = unknown.rbegin(); link != unknown.rend(); ++link) {
        const Affined local = to_affine(posed_transform(scene_, Id<Node>{link->id}, *link->node));
        const bool shown = link->node->visible && !is_root_of_other_scene(scene_, *link->node);
        const NodeTransform here =
            above ? NodeTransform{above->world_from_node * local, above->visible && shown} : NodeTransform{local, shown};
        above = &known_.insert_or_assign(link->id, here).first->second;
    }
    static const NodeTransform nowhere;
    return above ? *above : nowhere;
}

Affined world_from_node(const Scene& scene, Id<Node> node) { return WorldTransforms(scene)(node).world_from_node; }

Affined world_from_parent(const Scene& scene, const Node& node) { return node.parent ? world_from_node(scene, node.parent) : Affined{}; }

bool is_shadow_catcher(const Scene& scene, Id<Node> node) {
    size_t steps = 0; // ends cycles
    for (const Node* n = scene.nodes.find(node); n && steps <= scene.nodes.size(); n = scene.nodes.find(n->parent), ++steps)
        if (n->shadow_catcher) return true;
    return false;
}

bool is_visible(const Scene& scene, Id<Node> node) { return WorldTransforms(scene)(node).visible; }

} // namespace blush
