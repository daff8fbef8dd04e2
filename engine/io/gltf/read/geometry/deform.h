// Internal to io/gltf: imports morph targets and skinning weights of primitives.
#pragma once

#include "io/gltf/read/context.h"

#include <string>

namespace blush {

// True for JOINTS_0, WEIGHTS_1, ...
bool is_influence(const std::string& attribute);

// Sets targets and influences of a geometry that already has positions. Weights are normalised to sum 1 and non-finite numbers
// set to 0, with a warning. Errors: an accessor out of range or of another size than the positions.
Result<void> read_deformation(const GltfContext& context, const tinygltf::Primitive& primitive, Geometry& geometry,
                              const std::string& where);

// Limit of deformed vertices, summed over nodes, since a small file may use a large mesh on many nodes. Nodes beyond it keep the
// rest pose, with a warning.
constexpr size_t max_deformed_vertices = size_t(1) << 24;
void limit_deformation(const GltfContext& context, Scene& scene);

// Expands targets and influences to one vertex per index, for geometry that is about to be unwelded.
void unweld_deformation(Geometry& geometry);

} // namespace blush
