// Groups of pixels that share the second vertices of their paths (path_reuse.h).
#pragma once

#include <cstdint>

namespace blush {

// The film is divided into blocks, and a block into as many cells as a group has members. A group has one pixel of each cell, so
// neighbours are in different groups. The pixels are selected again for every sample: with fixed partners the common error would
// remain as a repeating texture that a denoiser keeps. The error of a block's mean is still common to its pixels and not reduced
// by sharing: the larger the block, the further that error is below the noise of its pixels, and the less visible are edges
// between blocks. Groups never cross blocks, so tiles made of whole blocks have whole groups, except at the film's border.
struct ReuseGroups {
    static constexpr int max_size = 16; // pixels in a group

    int columns = 1, rows = 1;             // of cells in a block
    int block_width = 1, block_height = 1; // pixels; powers of two

    constexpr int size() const { return columns * rows; }
    constexpr int cell_width() const { return block_width / columns; }
    constexpr int cell_height() const { return block_height / rows; }
    constexpr int per_block() const { return cell_width() * cell_height(); } // groups
    constexpr bool operator==(const ReuseGroups&) const = default;
};

// Groups of 4, 8 or 16 pixels; other sizes disable reuse. A block is a tile of one sample per pixel, unless smaller parts of the
// film have different numbers of samples.
constexpr ReuseGroups reuse_groups(int size, int block_width = 64, int block_height = 32) {
    switch (size) {
    case 4: return {2, 2, block_width, block_height};
    case 8: return {4, 2, block_width, block_height};
    case 16: return {4, 4, block_width, block_height};
    default: return {};
    }
}

// The groups of one block at one sample: a function of the block's position in the film and the sample's index alone.
class BlockGroups {
public:
    // (x, y): first pixel of the block in the film.
    BlockGroups(const ReuseGroups& groups, int x, int y, int64_t sample);

    struct Pixel {
        int x, y; // from the block's first pixel
    };
    // `group` in [0, per_block()), `member` in [0, size()): enumerates each pixel of the block exactly once.
    Pixel pixel(int group, int member) const;

private:
    ReuseGroups groups_;
    uint64_t keys_[ReuseGroups::max_size]; // of the cells' permutations
};

} // namespace blush
