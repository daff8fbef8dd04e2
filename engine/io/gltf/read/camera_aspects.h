// Reads the aspect ratios of a file's cameras. Lens does not store them, since the image size determines the rendered aspect.
#pragma once

#include "io/gltf/read/geometry/indices.h"

#include <map>

namespace blush {

// Width / height of the cameras that state it (perspective.aspectRatio; xmag / ymag), within 0.01 .. 100. Parses the JSON text.
std::map<Id<Camera>, float> camera_aspects(const GltfOrigin& origin);

} // namespace blush
