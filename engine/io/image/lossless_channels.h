// Lossless storage of doubles and integers in EXR: as 32-bit unsigned channels, two per double.
#pragma once

#include "core/lossless_plane.h"
#include "io/image/image_io.h"

#include <string>
#include <vector>

namespace blush {

// Channel names: LAYER.NAME.high and LAYER.NAME.low hold the bits of a double, LAYER.NAME.word an integer.
void add_lossless_plane(LayeredImage& image, const std::string& layer, const LosslessPlane& plane);
// All planes of the layer, in the order of the file's channels. Ignores channels with other names.
std::vector<LosslessPlane> lossless_planes(const LayeredImage& image, const std::string& layer);

} // namespace blush
