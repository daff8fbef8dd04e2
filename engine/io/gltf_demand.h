// Internal to gltf_*.cpp: how much a file asks for before anything is made of it.
#pragma once

#include "io/gltf_source.h"

#include <vector>

namespace blush {

// Primitives and animations may name the same bytes again and again, and accessors need none at all, so that a small file could ask for all the memory there
// is. Errors: the meshes of `nodes`, animations and skins ask for more than an honest file of this one's size.
Result<void> check_demand(const GltfContext& context, const std::vector<int>& nodes);

// What the numbers of a primitive take, as floats, in bytes; 0 for those that cannot be read.
double bytes_asked_by(const GltfContext& context, const tinygltf::Primitive& primitive);

} // namespace blush
