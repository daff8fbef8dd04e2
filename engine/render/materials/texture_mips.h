// Mip levels of an image: each has half the width and height of the previous one, down to a single texel.
#pragma once

#include <functional>
#include <span>

namespace blush {

// Number of mip levels, including the image itself.
int mip_count(int width, int height);

// Row y of an image as linear RGBA: 4 * width floats.
using ReadRow = std::function<void(int y, float* rgba)>;
// Row y of a level, as linear RGBA; level 1 is the largest after the image.
using TakeRow = std::function<void(int level, int y, std::span<const float> rgba)>;

// Reads the rows of an image from the top, each once, and passes on the rows of all smaller levels, each level from its top. Texels are
// area-weighted means, also for odd sizes, so that all levels have the mean of the image up to rounding. Needs memory for one row of
// each level.
void make_mips(int width, int height, const ReadRow& read, const TakeRow& take);

} // namespace blush
