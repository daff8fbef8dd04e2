// Evaluates the chosen animation clip at the chosen time: animated transforms and morph weights of nodes.
#pragma once

#include "scene/scene.h"

#include <span>

namespace blush {

// Channels of the chosen clip that animate a node; empty if there are none.
std::span<const Channel> channels_of(const Scene& scene, Id<Node> node);
// True if the chosen clip animates this property of the node: the node's own value is then not used.
bool is_animated(const Scene& scene, Id<Node> node, Channel::Property property);

// True if the chosen clip animates the node's translation, rotation or scale.
bool is_transform_animated(const Scene& scene, Id<Node> node);

// Animated transform; properties without a channel are the node's own. The matrix of an animated node is ignored: glTF forbids
// it.
Transform posed_transform(const Scene& scene, Id<Node> id, const Node& node);
std::vector<float> posed_morph_weights(const Scene& scene, Id<Node> id, const Node& node);

// True if the node is a root that does not belong to the chosen scene.
bool is_root_of_other_scene(const Scene& scene, const Node& node);

// True if neither the node nor an ancestor is such a root.
bool is_in_chosen_scene(const Scene& scene, Id<Node> node);

} // namespace blush
