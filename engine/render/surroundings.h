// What is seen around a pixel: means over the pixels next to it.
#pragma once

#include "render/half_rows.h"

namespace blush {

// Over the four blocks of 3 x 3 pixels that have a pixel in their corner, without that pixel; at the border, over what is there of them.
// Of the rows near one that moves down the picture.
class Surroundings {
public:
    Surroundings(int width, int height);

    // The picture's next row, from the one that the first block needs on.
    void add_row(const ChannelRows& own, int y);
    // Of row y, of one channel, whose values are `own`. Rows y - 2 to y + 2 must have been added, as far as there are any.
    struct Around {
        PixelRow mean;    // of the four blocks' means
        PixelRow darkest; // of these, the smallest
    };
    void look(size_t channel, int y, const PixelRow& own, Around& around) const;

private:
    static constexpr int kept = 4; // rows
    // Sums over the 3 x 3 pixels around, those that there are.
    const ChannelRows& blocks(int y) const { return blocks_[size_t(y % kept)]; }
    // One over the number of pixels in a block of row y but one.
    const PixelRow& inverse(int y) const { return y == 0 || y == height_ - 1 ? inverse_at_border_ : inverse_; }
    void sum_block_row(int y);
    void mirror(PixelRow& row) const;

    int width_, height_;
    std::array<ChannelRows, kept> across_; // sums over three pixels side by side, of row y at y % kept; so are
    std::array<ChannelRows, kept> blocks_;
    PixelRow inverse_, inverse_at_border_, nothing_;
};

} // namespace blush
