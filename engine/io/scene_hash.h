// One number for everything in a scene that reaches the image.
#pragma once

#include "scene/scene.h"

#include <string>

namespace blush {

// 64 bits as 16 hexadecimal digits. Equal for two imports of one file; names, sources, cameras and payload serials do not
// count, triangles and pixels do. Not cryptographic: it finds mistakes, not forgeries. Time is that of reading all payloads once.
std::string scene_hash(const Scene& scene);

} // namespace blush
