// Neighbourhood filter: means over the pixels around a pixel.
#pragma once

#include "render/error/half_buffer_rows.h"

namespace blush {

// Over the four blocks of 3 x 3 pixels that have the pixel in a corner, without that pixel; clipped at the border. Processes the
// image row by row from the top.
class NeighborhoodFilter {
public:
    NeighborhoodFilter(int width, int height);

    // Adds the next row; start with the first row that the first block needs.
    void add_row(const ChannelRows& own, int y);
    // Result for one channel of row y with values `own`. Rows y - 2 to y + 2 must have been added, as far as they exist.
    struct NeighborhoodMeans {
        PixelRow mean;    // of the four blocks' means
        PixelRow darkest; // the smallest of these means
    };
    void means(size_t channel, int y, const PixelRow& own, NeighborhoodMeans& around) const;

private:
    static constexpr int kept = 4; // rows
    // Sums over 3 x 3 pixels, clipped at the border.
    const ChannelRows& blocks(int y) const { return blocks_[size_t(y % kept)]; }
    // 1 / number of pixels in a block of row y, except for the horizontal border.
    const PixelRow& inverse(int y) const { return y == 0 || y == height_ - 1 ? inverse_at_border_ : inverse_; }
    void sum_block_row(int y);
    void mirror(PixelRow& row) const;

    int width_, height_;
    std::array<ChannelRows, kept> across_; // sums over three adjacent pixels, of row y at y % kept; so are
    std::array<ChannelRows, kept> blocks_;
    PixelRow inverse_, inverse_at_border_, nothing_;
};

} // namespace blush
