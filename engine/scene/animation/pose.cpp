#include "scene/animation/pose.h"

#include "scene/affine.h"
#include "scene/animation/keyframes.h"
#include "scene/world_transforms.h"

#include <algorithm>

namespace blush {
namespace {

using Property = Channel::Property;

Vec3 vector_at(const Channel& channel, float seconds) {
    const std::vector<float> v = value_at(*channel.keyframes, seconds);
    return {v[0], v[1], v[2]};
}

// True if the animated transform is not finite.
std::vector<Id<Node>> carried_off(const Scene& scene) {
    std::vector<Id<Node>> nodes;
    const Clip* clip = scene.staging.clip ? scene.clips.find(scene.staging.clip) : nullptr;
    WorldTransforms placements(scene);
    for (size_t i = 0; clip && i < clip->channels.size(); ++i)
        if (const Id<Node> id = clip->channels[i].node; scene.nodes.contains(id) && !is_finite(placements(id).world_from_node))
            nodes.push_back(id);
    return nodes;
}

} // namespace

std::span<const Channel> channels_of(const Scene& scene, Id<Node> node) {
    const Clip* clip = scene.staging.clip ? scene.clips.find(scene.staging.clip) : nullptr;
    if (!clip) return {};
    const auto found = std::ranges::equal_range(clip->channels, node, {}, &Channel::node);
    return {found.begin(), found.end()};
}

bool is_animated(const Scene& scene, Id<Node> node, Property property) {
    return std::ranges::any_of(channels_of(scene, node), [&](const Channel& c) { return c.property == property; });
}

bool is_transform_animated(const Scene& scene, Id<Node> node) {
    return std::ranges::any_of(channels_of(scene, node), [](const Channel& c) { return c.property != Property::morph_weights; });
}

Transform posed_transform(const Scene& scene, Id<Node> id, const Node& node) {
    Transform posed = node.local;
    for (const Channel& channel : channels_of(scene, id)) {
        if (channel.property == Property::morph_weights) continue;
        const float t = scene.staging.seconds;
        posed.matrix.reset();
        if (channel.property == Property::rotation)
            posed.rotation = rotation_at(*channel.keyframes, t);
        else
            (channel.property == Property::scale ? posed.scale : posed.translation) = vector_at(channel, t);
    }
    return posed;
}

std::vector<float> posed_morph_weights(const Scene& scene, Id<Node> id, const Node& node) {
    for (const Channel& channel : channels_of(scene, id))
        if (channel.property == Property::morph_weights) return value_at(*channel.keyframes, scene.staging.seconds);
    return node.morph_weights;
}

bool is_root_of_other_scene(const Scene& scene, const Node& node) {
    return !node.only_in_scenes.empty() && !node.parent &&
           std::ranges::find(node.only_in_scenes, scene.staging.scene) == node.only_in_scenes.end();
}

bool is_in_chosen_scene(const Scene& scene, Id<Node> id) {
    const Node* node = scene.nodes.find(id);
    for (size_t steps = 0; node && node->parent && steps < scene.nodes.size(); ++steps) node = scene.nodes.find(node->parent);
    return node && !is_root_of_other_scene(scene, *node);
}

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
    posed.staging = {};
    posed.clips = {};
    posed.scene_names.clear();
    return posed;
}

} // namespace blush
