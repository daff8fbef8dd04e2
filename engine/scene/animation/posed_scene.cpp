#include "scene/animation/posed_scene.h"

#include "scene/affine.h"
#include "scene/animation/pose.h"
#include "scene/world_transforms.h"

namespace blush {
namespace {

// Animated nodes whose transform is not finite.
std::vector<Id<Node>> carried_off(const Scene& scene) {
    std::vector<Id<Node>> nodes;
    const Clip* clip = scene.scene_selection.clip ? scene.clips.find(scene.scene_selection.clip) : nullptr;
    WorldTransforms transforms(scene);
    for (size_t i = 0; clip && i < clip->channels.size(); ++i)
        if (const Id<Node> id = clip->channels[i].node; scene.nodes.contains(id) && !is_finite(transforms(id).world_from_node))
            nodes.push_back(id);
    return nodes;
}

} // namespace

Scene with_pose_applied(const Scene& scene) {
    if (scene.clips.empty() && scene.scene_names.empty()) return scene;
    Scene posed = scene;
    for (const auto& [id, node] : scene.nodes) {
        if (node.only_in_scenes.empty() && channels_of(scene, id).empty()) continue;
        Node now = node;
        now.local = posed_transform(scene, id, node);
        now.morph_weights = posed_morph_weights(scene, id, node);
        now.visible = node.visible && !is_root_of_other_scene(scene, node);
        now.only_in_scenes.clear();
        posed.nodes.set(id, std::move(now));
    }
    for (const Id<Node> id : carried_off(scene)) {
        Node hidden = *posed.nodes.find(id);
        hidden.visible = false;
        posed.nodes.set(id, std::move(hidden));
    }
    posed.scene_selection = {};
    posed.clips = {};
    posed.scene_names.clear();
    return posed;
}

} // namespace blush
