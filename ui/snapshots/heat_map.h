// Colours of heat maps.
#pragma once

#include "core/vec.h"

#include <cstdint>

namespace blush {

// Heat map colour for 0 .. 1: black, blue, red, yellow, white; luminance increases, so that it is readable without colour.
Vec3 heat_map_color(float t);

// A scene-linear colour, clamped to 0 .. 1, as RGBA bytes of an sRGB texture in the order of ImGui.
uint32_t map_texel(const Vec3& linear);

} // namespace blush
