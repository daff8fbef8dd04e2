// Numbers that must survive to the last bit, as channels of an EXR: 32-bit unsigned ones, of which a double takes two.
#pragma once

#include "core/exact_plane.h"
#include "io/image_io.h"

#include <string>
#include <vector>

namespace blush {

// LAYER.NAME.high and LAYER.NAME.low for sums, the halves of their bits; LAYER.NAME.word for whole numbers.
void add_exact_plane(LayeredImage& image, const std::string& layer, const ExactPlane& plane);
// All that was added to that layer, in the order of the file's channels. Channels that are not of these kinds are left out.
std::vector<ExactPlane> exact_planes(const LayeredImage& image, const std::string& layer);

} // namespace blush
