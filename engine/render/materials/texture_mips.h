// Mip levels of an image: each has half the width and height of the previous one, down to a single texel.
#pragma once

#include <functional>
#include <vector>

namespace blush {

// Linear RGBA, top row first.
struct TextureMip {
    int width = 0, height = 0;
    std::vector<float> rgba;
};

// Number of mip levels, including the image itself.
int mip_count(int width, int height);

// Row y of an image as linear RGBA: 4 * width floats.
using ReadRow = std::function<void(int y, float* rgba)>;

// Calls take(mip) for each smaller level, largest first. Texels are area-weighted means, also for odd sizes, so that all levels
// have the mean of the image up to rounding.
void make_mips(int width, int height, const ReadRow& read, const std::function<void(const TextureMip&)>& take);

} // namespace blush
