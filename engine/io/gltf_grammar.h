// Internal to gltf_*.cpp: what a file says in words that glTF does not have.
#pragma once

#include "io/gltf_source.h"

namespace blush {

// Members of another type than the specification gives them, which are then read as if they were not there; extensions that are used but not
// declared; nodes that are placed twice; meshes without primitives.
void report_grammar(const GltfContext& context);

} // namespace blush
