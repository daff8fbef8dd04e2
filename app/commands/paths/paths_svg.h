// Paths as a picture for documents.
#pragma once

#include "app/commands/paths/pixel_paths.h"

#include <cstdint>
#include <span>
#include <string>

namespace blush {

// The paths as the render camera sees them, over a picture of the scene (PNG): self-contained, without scripts. One group for each sample.
// The first segment, which the camera sees as a point, is left out.
std::string paths_svg(const PixelPaths& p, std::span<const uint8_t> picture_png);

} // namespace blush
