// Internal to gltf_*.cpp: EXT_mesh_gpu_instancing, many copies of a node's mesh by arrays of translations, rotations and scales.
#pragma once

#include "io/gltf_document.h"
#include "io/gltf_source.h"

namespace blush {

// Copies of meshes in one file, each counted once for every primitive: beyond, a small file would ask for all the memory there is.
constexpr uint64_t most_instances = uint64_t(1) << 23;

// Where the copies of a node's mesh are; null if the node has none of the extension, or if all that it says is that they are where the node
// is. Copies that are nowhere (NaN, infinite) are left out with a warning, attributes of the user's own (`_ID`) reported as ignored.
// Errors: an accessor out of range or of the wrong type, attributes of unlike lengths.
Result<InstancesPtr> import_instances(const GltfContext& context, const tinygltf::Node& node, const std::string& where);

// What the document says of a node becomes `now`; it has `had` already.
void write_instances(GltfDocument& document, Json& object, const InstancesPtr& had, const InstancesPtr& now);

} // namespace blush
