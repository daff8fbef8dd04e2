// Values by key are sorted by counting and by comparison. Blocks of cells have numbers and places.
#include "render/lights/receiver_grid.h"

#include "tests/support/random_numbers.h"

#include <gtest/gtest.h>
#include <map>

namespace blush::test::TEST_FILE {
namespace {

// 40 different keys below `most`: small keys are sorted by counting, keys that are far apart by comparison.
TEST(ByKey, ValuesKeepTheirOrder) {
    for (const int32_t most : {40, 1'000'000'000}) {
        RandomNumbers random(5);
        std::vector<std::pair<int32_t, int>> entries;
        std::map<int32_t, std::vector<int>> expected;
        for (int i = 0; i < 1000; ++i) {
            const int32_t key = int32_t(random() * 40) * (most / 40);
            entries.emplace_back(key, i);
            expected[key].push_back(i);
        }
        const ByKey<int> by_key(entries);
        ASSERT_EQ(by_key.keys().size(), expected.size());
        size_t k = 0;
        for (const auto& [key, values] : expected) {
            EXPECT_EQ(by_key.keys()[k], key);
            const auto at = by_key.values_at(k++), of = by_key.values_of(key);
            EXPECT_EQ(std::vector(at.begin(), at.end()), values);
            EXPECT_EQ(std::vector(of.begin(), of.end()), values);
        }
        EXPECT_TRUE(by_key.values_of(most).empty());
    }
    EXPECT_TRUE(ByKey<int>({}).keys().empty());
}

TEST(CellBlocks, PlacesAreTheInverseOfNumbers) {
    ReceiverGrid grid;
    for (int axis = 0; axis < 3; ++axis) grid.cells[axis] = 5 + axis;
    const CellBlocks blocks{grid, 2};
    int cells = 0;
    for (int32_t block = 0; block < blocks.count(); ++block) {
        const auto [x, y, z] = blocks.place(block);
        EXPECT_EQ(blocks.at(x, y, z), block);
        blocks.for_each_cell(block, [&](int32_t cell) {
            EXPECT_EQ(blocks.of(cell), block);
            ++cells;
        });
    }
    EXPECT_EQ(cells, grid.count());
}

} // namespace
} // namespace blush::test::TEST_FILE
