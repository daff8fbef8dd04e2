// Internal to gltf_*.cpp: what an edit leaves without a use goes from the document; what had none before stays.
#pragma once

#include "io/gltf_document.h"

#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace blush {

using GltfObjects = std::set<std::pair<std::string_view, int>>; // (list, index)

// What can be reached from the scenes and animations.
GltfObjects used_objects(GltfDocument& document);

// Removes the objects that are not used any more: that are not reachable now, nor from what was not reachable before (`used_before` of
// `counts_before` objects). Indices, the document's own among them, are put right. Does nothing in a document with
// extensions whose references are not known; returns the number of objects that are then left without a use.
int remove_unused(GltfDocument& document, const GltfObjects& used_before, const std::map<std::string_view, int>& counts_before);

// Objects per list.
std::map<std::string_view, int> count_objects(GltfDocument& document);

} // namespace blush
