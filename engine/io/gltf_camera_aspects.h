// The aspect ratios of a file's cameras, which Lens does not hold: the picture's size decides what is rendered.
#pragma once

#include "io/gltf_indices.h"

#include <map>

namespace blush {

// Width over height of the cameras that say it (perspective.aspectRatio; xmag over ymag), within 0.01 .. 100. Reads the document's text.
std::map<Id<Camera>, float> camera_aspects(const GltfOrigin& origin);

} // namespace blush
