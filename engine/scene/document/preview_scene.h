// Preview scene without textures, shown while the textures load.
#pragma once

#include "scene/scene.h"

namespace blush {

// The same scene without textures. Colours and factors of textured inputs are scaled as if every texel were sRGB 0.5 (0.21
// linear), since factors alone would make most scenes white or metallic. Materials with a metallic texture become non-metallic,
// those with a specular colour texture get at least medium roughness. Normal maps and alpha masks are ignored.
Scene preview_scene(Scene scene);

} // namespace blush
