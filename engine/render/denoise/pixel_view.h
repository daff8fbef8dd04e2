// A view of the pixels of an image, as the denoiser reads them.
#pragma once

#include <span>

namespace blush {

// Three interleaved components of each pixel, `stride` floats apart, top row first. Empty: absent.
struct PixelView {
    std::span<const float> values = {};
    int stride = 3;
};

} // namespace blush
