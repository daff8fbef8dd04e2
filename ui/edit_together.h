// Several lights edited as one: which they are, and what an edit of one of them means for the others. Pure.
#pragma once

#include "scene/edit.h"

#include <functional>
#include <span>

namespace blush {

// Those that hang below none of the others: what an edit of whole branches is for.
std::vector<Id<Node>> topmost(const Scene& scene, std::span<const Id<Node>> nodes);
// The lights of these nodes and all below them, each once.
std::vector<Id<Light>> lights_of(const Scene& scene, std::span<const Id<Node>> nodes);

// What `other` becomes where `before` was edited into `after`: every field that differs is taken over, but an intensity by its ratio, so
// that the balance of the lights stays, and a name not at all. Sizes and cones pass only between lights of one kind.
Light edited_alike(const Light& other, const Light& before, const Light& after);

// One edit for each light that `change` changes.
std::vector<Edit> change_lights(const Scene& scene, std::span<const Id<Light>> lights, const std::function<void(Light&)>& change);
// In which of their fields that the inspector shows lights differ, in its words.
std::vector<std::string> differing_fields(const Scene& scene, std::span<const Id<Light>> lights);
// "Mute light Key", "Mute 3 lights".
std::string label_for(const std::string& what, const Scene& scene, std::span<const Id<Light>> lights);

} // namespace blush
