// Internal to io/gltf: reports which extensions of the file are supported.
#pragma once

#include "io/gltf/read/context.h"

namespace blush {

// Sorts the used extensions into honoured, approximated and ignored, and adds the messages of the parser.
void report_file(const GltfContext& context);

} // namespace blush
