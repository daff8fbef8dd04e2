// Which part of a picture is object and which is background.
#pragma once

#include "render/frame.h"

#include <vector>

namespace blush {

// A value a pixel: 1 where an object is, 0 where the camera sees past all of them. Of the first sample of each pixel, so that edges are
// those of pixels; where the environment is hidden from the camera it is the frame's alpha, which is exact. Without ids everything is
// object.
std::vector<float> coverage_of(const Frame& frame);
// The opacity of each pixel of a picture that is to be laid over others (Frame::transparent); empty for any other.
std::vector<float> opacity_of(const Frame& frame);
float coverage_of_pixel(const Frame& frame, size_t pixel);

} // namespace blush
