// Internal to gltf_*.cpp: morph targets of primitives, and the joints that their vertices follow.
#pragma once

#include "io/gltf_source.h"

#include <string>

namespace blush {

// JOINTS_0, WEIGHTS_1, ...
bool is_influence(const std::string& attribute);

// Fills in targets and influences of a geometry that has its positions. Weights are made to sum to 1, numbers that are not finite to be 0,
// with a warning. Errors: an accessor out of range or of another size than the positions.
Result<void> read_bending(const GltfContext& context, const tinygltf::Primitive& primitive, Geometry& geometry, const std::string& where);

// A small file may hang a large mesh on any number of nodes: beyond this many vertices in all they stay at rest, with a warning.
constexpr size_t most_bent_vertices = size_t(1) << 24;
void limit_bending(const GltfContext& context, Scene& scene);

// For vertices that are about to be listed anew, one for each index.
void unweld_bending(Geometry& geometry);

} // namespace blush
