// Hash of everything in a scene that affects the image.
#pragma once

#include "scene/scene.h"

#include <string>

namespace blush {

// 64 bits as 16 hexadecimal digits. Equal for two imports of one file; ignores names, sources, cameras and payload serials,
// includes triangles and pixels. Not cryptographic. Reads all payloads once.
std::string scene_hash(const Scene& scene);

} // namespace blush
