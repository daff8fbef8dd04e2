// Internal to gltf_*.cpp: skins and clips that came with an import of another file, or with a copy of what was there. Those of the document
// itself stay as they are.
#pragma once

#include "io/gltf_document.h"

namespace blush {

// The document has all nodes of the scene. Adds the skins that nodes use and it lacks, and says at each node which it hangs on.
void write_skins(GltfDocument& document, const Scene& scene);
// Adds an animation for each clip that the document lacks and that leads nodes of the scene.
void write_animations(GltfDocument& document, const Scene& scene);

} // namespace blush
