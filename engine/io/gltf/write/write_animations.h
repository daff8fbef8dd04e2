// Internal to io/gltf: writes skins and clips that were imported from another file or duplicated. Those of the document are
// not changed.
#pragma once

#include "io/gltf/write/document.h"

namespace blush {

// Adds missing skins and sets the skin of each node. The document must have all nodes of the scene.
void write_skins(GltfDocument& document, const Scene& scene);
// Adds an animation for each missing clip that animates nodes of the scene.
void write_animations(GltfDocument& document, const Scene& scene);

} // namespace blush
