// Internal to io/gltf: prunes objects that an edit leaves unused. Objects that were unused before are kept.
#pragma once

#include "io/gltf/write/document.h"

#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace blush {

using GltfObjects = std::set<std::pair<std::string_view, int>>; // (list, index)

// Objects that are reachable from the scenes and animations.
GltfObjects used_objects(GltfDocument& document);

// Removes objects that are neither reachable now nor from objects that were unreachable before (`used_before` of `counts_before`
// objects), and updates all indices. Does nothing if the document has extensions with unknown references; returns the number of
// unused objects that are then kept.
int prune_unused(GltfDocument& document, const GltfObjects& used_before, const std::map<std::string_view, int>& counts_before);

// Number of objects per list.
std::map<std::string_view, int> count_objects(GltfDocument& document);

} // namespace blush
