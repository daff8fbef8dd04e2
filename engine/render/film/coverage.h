// Coverage of an image: object or background.
#pragma once

#include "render/frame.h"

#include <vector>

namespace blush {

// One value per pixel: 1 for objects, 0 for the background. Uses the first sample of each
// pixel, so edges are not antialiased; if the environment is hidden from the camera it is
// the frame's alpha, which is exact. Without object ids, all pixels count as objects.
std::vector<float> coverage_of(const Frame& frame);
// The opacity of each pixel of an image for compositing (Frame::transparent); empty for other images.
std::vector<float> opacity_of(const Frame& frame);
float coverage_of_pixel(const Frame& frame, size_t pixel);

} // namespace blush
