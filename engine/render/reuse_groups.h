// Which pixels of the film share the second vertices of their paths (path_reuse.h).
#pragma once

#include <cstdint>

namespace blush {

// The film is cut into blocks, and a block into as many cells as a group has members. A group has one pixel of each cell, so that
// neighbours are in different groups. Which pixels these are is drawn anew for every sample: if a pixel had the same partners for all its
// samples, their common error would stay, as a texture that repeats from cell to cell and that a denoiser keeps. The pixels of a block
// still have the error of the block's mean in common, which sharing does not lower: the larger the block, the further that is below the
// noise of its pixels, and the less it shows as an edge between blocks. No group reaches out of its block, so a tile that begins and ends
// with blocks has its groups whole, but for the film's border.
struct ReuseGroups {
    static constexpr int largest = 16; // pixels in a group

    int columns = 1, rows = 1;             // of cells in a block
    int block_width = 1, block_height = 1; // pixels; powers of two

    constexpr int size() const { return columns * rows; }
    constexpr int cell_width() const { return block_width / columns; }
    constexpr int cell_height() const { return block_height / rows; }
    constexpr int per_block() const { return cell_width() * cell_height(); } // groups
    constexpr bool operator==(const ReuseGroups&) const = default;
};

// Of 4, 8 or 16 pixels; any other size is no group. A block is a tile of one sample per pixel, unless smaller parts of the film have
// numbers of samples of their own.
constexpr ReuseGroups reuse_groups(int size, int block_width = 64, int block_height = 32) {
    switch (size) {
    case 4: return {2, 2, block_width, block_height};
    case 8: return {4, 2, block_width, block_height};
    case 16: return {4, 4, block_width, block_height};
    default: return {};
    }
}

// The groups of one block at one sample: a function of the block's place in the film and the sample's index alone.
class BlockGroups {
public:
    // (x, y): first pixel of the block in the film.
    BlockGroups(const ReuseGroups& groups, int x, int y, int64_t sample);

    struct Pixel {
        int x, y; // from the block's first pixel
    };
    // `group` in [0, per_block()), `member` in [0, size()): each pixel of the block exactly once.
    Pixel pixel(int group, int member) const;

private:
    ReuseGroups groups_;
    uint64_t keys_[ReuseGroups::largest]; // of the cells' permutations
};

} // namespace blush
