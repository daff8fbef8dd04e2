// Internal to the import: adds decompressed data to the parsed file.
#pragma once

#include "io/gltf/read/source.h"

#include <cstdint>
#include <vector>

namespace blush {

// Adds a buffer (or a view of a whole buffer) and returns its index.
int add_decompressed_buffer(GltfSource& source, std::vector<uint8_t> bytes);
int add_decompressed_view(GltfSource& source, std::vector<uint8_t> bytes);

} // namespace blush
