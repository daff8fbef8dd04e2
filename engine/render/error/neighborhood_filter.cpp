#include "render/error/neighborhood_filter.h"

#include <algorithm>

namespace blush {

NeighborhoodFilter::NeighborhoodFilter(int width, int height)
    : width_(width), height_(height), inverse_(width), inverse_at_border_(width), nothing_(width) {
    const PixelRow row(width);
    for (auto* rows : {&across_, &blocks_}) rows->fill({row, row, row});
    const auto clipped_count = [](int at, int size) { return std::min(at + 1, size - 1) - std::max(at - 1, 0) + 1; };
    const auto fill = [&](PixelRow& inverse, int rows) {
        for (int x = 0; x < width; ++x) inverse[x] = 1.f / float(std::max(1, clipped_count(x, width) * rows - 1));
        mirror(inverse);
    };
    fill(inverse_, 3);
    fill(inverse_at_border_, clipped_count(0, height));
}

// Mirrors the row at the border, so that border pixels use the inner blocks twice.
void NeighborhoodFilter::mirror(PixelRow& row) const {
    if (width_ < 2) return;
    row[-1] = row[1];
    row[width_] = row[width_ - 2];
}

void NeighborhoodFilter::add_row(const ChannelRows& own, int y) {
    ChannelRows& across = across_[size_t(y % kept)];
    for (size_t c = 0; c < 3; ++c) {
        const float* const from = own[c].pixels();
        float* const to = across[c].pixels();
        for (int x = 0; x < width_; x += PixelRow::step)
            store(to + x, load<Wide>(from + x - 1) + load<Wide>(from + x) + load<Wide>(from + x + 1));
    }
    if (y > 0) sum_block_row(y - 1);
    if (y == height_ - 1) sum_block_row(y);
}

void NeighborhoodFilter::sum_block_row(int y) {
    for (size_t c = 0; c < 3; ++c) {
        const float* const row = across_[size_t(y % kept)][c].pixels();
        const float* const above = y > 0 ? across_[size_t((y - 1) % kept)][c].pixels() : nothing_.pixels();
        const float* const below = y + 1 < height_ ? across_[size_t((y + 1) % kept)][c].pixels() : nothing_.pixels();
        PixelRow& block = blocks_[size_t(y % kept)][c];
        float* const to = block.pixels();
        for (int x = 0; x < width_; x += PixelRow::step) store(to + x, load<Wide>(row + x) + load<Wide>(above + x) + load<Wide>(below + x));
        mirror(block);
    }
}

void NeighborhoodFilter::means(size_t channel, int y, const PixelRow& own, NeighborhoodMeans& around) const {
    if (width_ < 2 || height_ < 2) {
        around.mean = around.darkest = own;
        return;
    }
    const int above = y > 0 ? y - 1 : 1, below = y + 1 < height_ ? y + 1 : height_ - 2;
    const float *const block_above = blocks(above)[channel].pixels(), *const block_below = blocks(below)[channel].pixels();
    const float *const inverse_above = inverse(above).pixels(), *const inverse_below = inverse(below).pixels();
    const float* const values = own.pixels();
    float *const to_mean = around.mean.pixels(), *const to_darkest = around.darkest.pixels();
    for (int x = 0; x < width_; x += PixelRow::step) {
        const Wide value = load<Wide>(values + x);
        // Sums of floats: next to a bright pixel, the remainder of dark ones may be rounding error.
        const auto mean = [&](const float* block, const float* inverse, int at) {
            return max(Wide(0.f), (load<Wide>(block + at) - value) * load<Wide>(inverse + at));
        };
        const Wide a = mean(block_above, inverse_above, x - 1), b = mean(block_above, inverse_above, x + 1);
        const Wide c = mean(block_below, inverse_below, x - 1), d = mean(block_below, inverse_below, x + 1);
        store(to_mean + x, (a + b + c + d) * 0.25f);
        store(to_darkest + x, min(min(a, b), min(c, d)));
    }
}

} // namespace blush
