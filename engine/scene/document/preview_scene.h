// Preview scene, shown while the textures load.
#pragma once

#include "scene/scene.h"

namespace blush {

// The same scene without the textures that have no image yet. Colours and factors of inputs that lack their texture are scaled as if
// every texel were sRGB 0.5 (0.21 linear), since factors alone would make most scenes white or metallic. Materials that lack a
// metallic texture become non-metallic, those that lack a specular colour texture get at least medium roughness. Their normal maps
// and alpha masks are ignored.
Scene preview_scene(Scene scene);

} // namespace blush
