// Where the chosen clip has the nodes of a scene at the chosen moment.
#pragma once

#include "scene/scene.h"

#include <span>

namespace blush {

// What the chosen clip does to a node; empty where it leaves it at rest.
std::span<const Channel> channels_of(const Scene& scene, Id<Node> node);
// The chosen clip leads this property of the node: what the node itself says of it is not seen.
bool is_led(const Scene& scene, Id<Node> node, Channel::Property property);

// It leads its place, rotation or scale.
bool is_placed_by_clip(const Scene& scene, Id<Node> node);

// As chosen; what no channel leads is the node's own. A node that is led lets go of its matrix, of which glTF has none there.
Transform posed_transform(const Scene& scene, Id<Node> id, const Node& node);
std::vector<float> posed_morph_weights(const Scene& scene, Id<Node> id, const Node& node);

// A root of another scene of the file than the chosen one.
bool is_of_other_scene(const Scene& scene, const Node& node);

// Neither the node nor what it hangs below is.
bool is_in_chosen_scene(const Scene& scene, Id<Node> node);

// The scene with clip, moment and choice of scene spelled out in its nodes, and then forgotten: it looks the same. Nodes that the clip carries
// beyond all numbers are hidden.
Scene with_pose_applied(const Scene& scene);

} // namespace blush
