// Converts cube maps to lat-long environment maps.
#pragma once

#include "core/result.h"
#include "scene/scene.h"

#include <array>

namespace blush {

// Faces towards +X, -X, +Y, -Y, +Z, -Z: float, 3 or 4 channels, square, of equal size. Up is +Y; for the +Y face -Z, for the -Y
// face +Z. Not mirrored, as in EXT_lights_image_based: flipped relative to the OpenGL convention.
using CubeFaces = std::array<ImagePtr, 6>;

// Lat-long map (Environment::image) of the rotated cube. Each texel is the mean of four bilinear lookups. Resolution: the texels
// of a face per 90 degrees, at most 4096 wide. Errors: faces that do not form a cube.
Result<ImagePtr> lat_long_of(const CubeFaces& faces, const Quat& rotation);

} // namespace blush
