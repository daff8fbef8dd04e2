// Environments from cube maps, six pictures of what one sees from within a cube.
#pragma once

#include "core/result.h"
#include "scene/scene.h"

#include <array>

namespace blush {

// Looking along +X, -X, +Y, -Y, +Z, -Z: float, 3 or 4 channels, square, of one size. Up is +Y, but -Z looking along +Y and +Z along -Y; they
// are not mirrored, which is how EXT_lights_image_based has them: flipped from what graphics cards have.
using CubeFaces = std::array<ImagePtr, 6>;

// The lat-long map (Environment::image) of the cube after it has been turned. Texels are means of four bilinear look-ups; as many to the
// right angle as a face has, but no more than 4096 all around. Errors: faces that are no cube.
Result<ImagePtr> lat_long_of(const CubeFaces& faces, const Quat& rotation);

} // namespace blush
