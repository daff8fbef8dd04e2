// What is seen around a pixel: means over the pixels next to it.
#pragma once

#include "core/vec.h"

#include <span>
#include <vector>

namespace blush {

// Over the four blocks of 3 x 3 pixels that have a pixel in their corner, without that pixel; at the border, over what is there of them.
class Surroundings {
public:
    // rgba: 4 floats per pixel, width * height of them. For pixels of rows [first_row, last_row).
    Surroundings(std::span<const float> rgba, int width, int height, int first_row, int last_row);

    struct Around {
        Vec3d mean;    // of the four blocks' means
        Vec3d darkest; // of these, the smallest of each colour
    };
    // The pixel itself for a picture of one pixel's width or height.
    Around around(int x, int y) const;

private:
    int pixels_in_block(int x, int y) const;

    std::span<const float> rgba_;
    int width_, height_, first_; // first_: the row that blocks_ begins with
    std::vector<Vec3> blocks_;   // sums over the 3 x 3 pixels around, those that there are
};

} // namespace blush
