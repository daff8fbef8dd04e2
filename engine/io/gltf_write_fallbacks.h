// Internal to gltf_*.cpp: surfaces that glow like area lights, for programs that know neither EXT_lights_area nor us.
#pragma once

#include "io/gltf_document.h"

namespace blush {

// Each node with a rectangle or disk that is on gets a child with a glowing polygon, marked as a fallback (gltf_extras.h); a child that is
// there already is put right; one whose light is gone, off or of another kind goes.
void write_fallbacks(GltfDocument& document, const Scene& scene);

} // namespace blush
