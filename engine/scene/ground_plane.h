// A floor to stand a model on.
#pragma once

#include "scene/scene.h"

namespace blush {

// A scene of one node with a large matte grey square: level, just below the lowest point of `box` (world metres) and centred under it, ten times
// its radius to each side. To be merged with Import. `catches_shadows`: it is a shadow catcher.
Scene ground_plane_under(const Bounds& box, bool catches_shadows = false);

} // namespace blush
