// Internal to gltf_*.cpp: what the file asks for that the picture will not show.
#pragma once

#include "io/gltf_source.h"

namespace blush {

// Sorts the extensions in use into honoured, approximated and ignored, and lists what the parser said.
void report_file(const GltfContext& context);

} // namespace blush
