#include "render/denoise/tiles.h"

#include "render/denoise/unet_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace denoise;

// True if the network input covers the receptive field of the part from `begin` to `end`, as far as the image extends.
bool covers_receptive_field(int begin, int end, int seen, int seen_size, int side) {
    return seen <= std::max(0, begin - unet_reach) && seen + seen_size >= std::min(side, end + unet_reach);
}

TEST(Tiles, CoverEveryPixelOnceWithItsReceptiveField) {
    for (const auto& [width, height] : {std::pair{1, 1}, {15, 17}, {1000, 300}, {1921, 1081}, {5000, 20}, {208, 209}})
        for (const int64_t most_pixels : {43264, 100000, 1 << 20, 1 << 30}) {
            const auto grid = choose_tiles(width, height, [&](int w, int h) { return int64_t(w) * h <= most_pixels; });
            ASSERT_TRUE(grid);
            EXPECT_LE(int64_t(grid->width) * grid->height, most_pixels);
            EXPECT_EQ(grid->width % unet_side_multiple, 0);
            EXPECT_EQ(grid->height % unet_side_multiple, 0);
            std::vector<int> covered(size_t(width) * height);
            for (int row = 0; row < grid->rows; row++)
                for (int column = 0; column < grid->columns; column++) {
                    const Tile tile = tile_at(*grid, column, row);
                    EXPECT_LT(tile.left, tile.right);
                    EXPECT_LT(tile.top, tile.bottom);
                    EXPECT_EQ(tile.x % unet_side_multiple, 0);
                    EXPECT_EQ(tile.y % unet_side_multiple, 0);
                    EXPECT_TRUE(covers_receptive_field(tile.left, tile.right, tile.x, grid->width, width));
                    EXPECT_TRUE(covers_receptive_field(tile.top, tile.bottom, tile.y, grid->height, height));
                    for (int y = tile.top; y < tile.bottom; y++)
                        for (int x = tile.left; x < tile.right; x++) covered[size_t(y) * width + x]++;
                }
            EXPECT_EQ(std::ranges::count(covered, 1), std::ssize(covered)) << width << "x" << height << " in " << most_pixels;
        }
}

TEST(Tiles, OneIfItFits) {
    const auto grid = choose_tiles(1921, 1081, [](int, int) { return true; });
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->columns * grid->rows, 1);
    EXPECT_EQ(grid->width, 1936);
    EXPECT_EQ(grid->height, 1088);
}

TEST(Tiles, NoneIfNotEvenTheSmallestFits) {
    EXPECT_FALSE(choose_tiles(65536, 65536, [](int, int) { return false; }));
    EXPECT_FALSE(choose_tiles(1, 1, [](int, int) { return false; }));
}

} // namespace
} // namespace blush::test::TEST_FILE
