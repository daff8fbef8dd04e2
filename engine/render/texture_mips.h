// Smaller versions of an image: each has half the width and height of the one before, down to a single texel.
#pragma once

#include <functional>
#include <vector>

namespace blush {

// Linear RGBA, top row first.
struct TextureMip {
    int width = 0, height = 0;
    std::vector<float> rgba;
};

// How many versions an image has, itself among them.
int mip_count(int width, int height);

// Row y of an image as linear RGBA: 4 * width floats.
using ReadRow = std::function<void(int y, float* rgba)>;

// Calls take(mip) for each smaller version, the largest first. Texels are the mean of what they cover, also where a side is odd, so that all
// versions have the mean of the image, but for rounding.
void make_mips(int width, int height, const ReadRow& read, const std::function<void(const TextureMip&)>& take);

} // namespace blush
