// A ground plane under a model.
#pragma once

#include "scene/scene.h"

namespace blush {

// Scene of one node with a diffuse grey square, to be merged with Import. The square is horizontal, just below `box` (world
// metres) and centred; half its side is ten radii of the box. `catches_shadows`: the plane is a shadow catcher.
Scene ground_plane_under(const Bounds& box, bool catches_shadows = false);

} // namespace blush
