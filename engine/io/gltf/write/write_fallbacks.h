// Internal to io/gltf: writes emissive meshes as fallbacks of area lights, for programs without EXT_lights_area.
#pragma once

#include "io/gltf/write/document.h"

namespace blush {

// Each node with an enabled rectangle or disk light gets a child with an emissive polygon, marked as a fallback (io/gltf/read/extras.h).
// Existing children are updated, or removed if the light is gone, disabled or of another kind.
void write_fallbacks(GltfDocument& document, const Scene& scene);

} // namespace blush
