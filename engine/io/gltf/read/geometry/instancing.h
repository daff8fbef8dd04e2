// Internal to io/gltf: EXT_mesh_gpu_instancing, instances of a node's mesh from arrays of translations, rotations and scales.
#pragma once

#include "io/gltf/read/context.h"
#include "io/gltf/write/document.h"

namespace blush {

// Limit of instances in a file, counted per primitive, since a small file could require any amount of memory.
constexpr uint64_t max_instances = uint64_t(1) << 23;

// Transforms of the instances of a node's mesh; null if the node lacks the extension or all instances are at the node. Non-finite
// instances are skipped with a warning; custom attributes (`_ID`) are reported as ignored. Errors: an accessor out of range or of
// the wrong type, attributes of different lengths.
Result<InstancesPtr> import_instances(const GltfContext& context, const tinygltf::Node& node, const std::string& where);

// Changes the instances of a node in the document from `had` to `now`.
void write_instances(GltfDocument& document, Json& object, const InstancesPtr& had, const InstancesPtr& now);

} // namespace blush
