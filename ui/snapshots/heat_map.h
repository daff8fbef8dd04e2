// Colours of heat maps.
#pragma once

#include "core/vec.h"

namespace blush {

// Heat map colour for 0 .. 1: black, blue, red, yellow, white; luminance increases, so that it is readable without colour.
Vec3 heat_map_color(float t);

} // namespace blush
