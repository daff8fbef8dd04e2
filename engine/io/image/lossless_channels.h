// Lossless storage of doubles and integers in EXR: as 32-bit unsigned channels, two per double.
#pragma once

#include "core/lossless_plane.h"
#include "io/image/image_io.h"

#include <string>
#include <vector>

namespace blush {

// Channel names: LAYER.NAME.high and LAYER.NAME.low hold the bits of a double, LAYER.NAME.word an integer. Exact sums also have
// LAYER.NAME.low_bin.high and .low.
void add_lossless_plane(LayeredImage& image, const std::string& layer, const LosslessPlane& plane);
// All planes of the layer, in the order of the file's channels, whose values the image loses: a film may fill most of the memory.
// Ignores channels with other names.
std::vector<LosslessPlane> take_lossless_planes(LayeredImage& image, const std::string& layer);

} // namespace blush
