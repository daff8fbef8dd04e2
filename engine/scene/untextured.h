// A scene as it is shown while its textures are still being read.
#pragma once

#include "scene/scene.h"

namespace blush {

// The same scene without textures. Where a material has one, its colours and strengths are dimmed as if every texel were half-way between black
// and white, as an image file has it (0.21 as light); surfaces whose metalness is painted are none of metal, and those with a painted reflectance
// no mirrors: factors alone would make most scenes white, or metal. Normals are those of the triangles, and what is cut out by alpha is whole.
Scene untextured(Scene scene);

} // namespace blush
