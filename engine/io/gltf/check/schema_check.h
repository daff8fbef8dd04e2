// Internal to io/gltf: schema check. Reports JSON that violates the glTF schema.
#pragma once

#include "io/gltf/read/context.h"

namespace blush {

// Warns about members of the wrong type (read as absent), extensions that are used but not declared, nodes with both matrix and
// TRS, and meshes without primitives.
void check_schema(const GltfContext& context);

} // namespace blush
