// Multi-edit of lights: which lights are edited, and how an edit of one is applied to the others. Pure.
#pragma once

#include "scene/document/edit.h"

#include <functional>
#include <span>

namespace blush {

// The nodes that are not descendants of others in the set: for edits of whole subtrees.
std::vector<Id<Node>> subtree_roots(const Scene& scene, std::span<const Id<Node>> nodes);
// The lights of these nodes and all their descendants, without duplicates.
std::vector<Id<Light>> lights_of(const Scene& scene, std::span<const Id<Node>> nodes);

// Applies the edit `before` -> `after` to `other`: copies every field that differs, except that intensity is scaled by its ratio,
// which keeps the balance of the lights, and the name is not copied. Sizes and cones are only copied between lights of the same
// type.
Light apply_same_edit(const Light& other, const Light& before, const Light& after);

// One edit for each light that `change` modifies.
std::vector<Edit> change_lights(const Scene& scene, std::span<const Id<Light>> lights, const std::function<void(Light&)>& change);
// Labels of the inspector's fields in which the lights differ.
std::vector<std::string> differing_fields(const Scene& scene, std::span<const Id<Light>> lights);
// "Mute light Key", "Mute 3 lights". A single light has the name of its node in the subtrees of `nodes`, or else of its first node.
std::string label_for(const std::string& what, const Scene& scene, std::span<const Id<Light>> lights, std::span<const Id<Node>> nodes);

} // namespace blush
