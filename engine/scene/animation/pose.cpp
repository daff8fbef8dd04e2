#include "scene/animation/pose.h"

#include "scene/animation/keyframes.h"

#include <algorithm>

namespace blush {
namespace {

using Property = Channel::Property;

Vec3 vector_at(const Channel& channel, float seconds) {
    const std::vector<float> v = value_at(*channel.keyframes, seconds);
    return {v[0], v[1], v[2]};
}

} // namespace

std::span<const Channel> channels_of(const Scene& scene, Id<Node> node) {
    const Clip* clip = scene.scene_selection.clip ? scene.clips.find(scene.scene_selection.clip) : nullptr;
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
        const float t = scene.scene_selection.seconds;
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
        if (channel.property == Property::morph_weights) return value_at(*channel.keyframes, scene.scene_selection.seconds);
    return node.morph_weights;
}

bool is_root_of_other_scene(const Scene& scene, const Node& node) {
    return !node.only_in_scenes.empty() && !node.parent &&
           std::ranges::find(node.only_in_scenes, scene.scene_selection.scene) == node.only_in_scenes.end();
}

bool is_in_chosen_scene(const Scene& scene, Id<Node> id) {
    const Node* node = scene.nodes.find(id);
    for (size_t steps = 0; node && node->parent && steps < scene.nodes.size(); ++steps) node = scene.nodes.find(node->parent);
    return node && !is_root_of_other_scene(scene, *node);
}

} // namespace blush
