// Small files with one fault each, and valid ones, for tests of the import report.
#pragma once

#include "tests/io/gltf/builder.h"

#include <map>

namespace blush::test {

// By name: the text of a .gltf, or a .glb's bytes.
using GltfFiles = std::map<std::string, std::string>;

GltfFiles valid_files();
GltfFiles broken_files();

} // namespace blush::test
