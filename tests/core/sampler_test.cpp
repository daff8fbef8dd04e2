// Sampler: each pair of dimensions is a (0,2)-sequence in base 2, also over the pixels of a block; pairs and blocks are independent.
#include "core/sampler.h"

#include "tests/support/statistics.h"

#include <random>

namespace blush::TEST_FILE {

using namespace statistics;

namespace {

Sampler<float> sampler(uint32_t x, uint32_t y, uint32_t index, uint32_t seed = 7) {
    return pixel_sampler<float>(x, y, randomisation(seed, 0), index);
}

// True if every elementary interval of area 2^-k holds exactly one of the 2^k points.
bool is_net(const std::vector<Pair<float>>& points, int k) {
    for (int a = 0; a <= k; ++a) {
        std::vector<bool> taken(size_t(1) << k);
        for (const Pair<float>& p : points) {
            const uint64_t column = (uint64_t(p.bits_x) << a) >> 32, row = (uint64_t(p.bits_y) << (k - a)) >> 32;
            const size_t cell = size_t((column << (k - a)) | row);
            if (taken[cell]) return false;
            taken[cell] = true;
        }
    }
    return true;
}
// The 2^k points from `first`.
bool is_net(uint32_t x, uint32_t y, uint32_t dimension, uint32_t first, int k) {
    std::vector<Pair<float>> points;
    for (uint32_t i = 0; i < 1u << k; ++i) points.push_back(sampler(x, y, first + i).pair(dimension));
    return is_net(points, k);
}

// Where the blocks of pixels begin that have a key of their own.
constexpr uint32_t block_side = 1u << block_bits;

// Sample `sample` of a pixel with independent samples.
Sampler<float> independent(uint32_t x, uint32_t y, uint32_t sample) {
    return independent_sampler<float>(x, y, randomisation(7, 0), sample);
}

} // namespace

TEST(Sampler, EveryAlignedRunOfPointsIsANet) {
    for (uint32_t pixel = 0; pixel < 4; ++pixel)
        for (const uint32_t dimension : {0u, 1u, 5u, 77u})
            for (int k = 0; k <= 9; ++k) {
                EXPECT_TRUE(is_net(pixel, pixel * 3, dimension, 0, k)) << "pixel " << pixel << ", dimension " << dimension << ", 2^" << k;
                EXPECT_TRUE(is_net(pixel, 9, dimension, 3u << k, k)) << "pixel " << pixel << ", dimension " << dimension << ", 2^" << k;
            }
}

// Complementary points of neighbours: all first 2^b points of a square of pixels are together a net.
TEST(Sampler, PointsOfASquareOfPixelsAreANet) {
    for (int side_bits = 1; side_bits <= block_bits; ++side_bits)
        for (int b = 0; b <= 10 && 2 * side_bits + b <= 13; ++b)
            for (const uint32_t dimension : {0u, 2u, 3u, 50u}) {
                const uint32_t side = 1u << side_bits, left = 40 + 3 * side % block_side, top = 16 + side % block_side;
                std::vector<Pair<float>> points;
                for (uint32_t y = 0; y < side; ++y)
                    for (uint32_t x = 0; x < side; ++x)
                        for (uint32_t i = 0; i < 1u << b; ++i) points.push_back(sampler(left + x, top + y, i).pair(dimension));
                EXPECT_TRUE(is_net(points, 2 * side_bits + b)) << side << " pixels wide, 2^" << b << " points, dimension " << dimension;
            }
}

// Whatever its place in the block: over seeds, each point of each pixel is uniform.
TEST(Sampler, EveryPlaceInABlockIsUniformOverSeeds) {
    constexpr int cells = 8, seeds = 4096;
    const std::vector<double> expected(cells * cells, double(seeds) / (cells * cells));
    for (uint32_t place = 0; place < block_side * block_side; ++place) {
        std::vector<int64_t> counts(cells * cells);
        for (uint32_t seed = 0; seed < seeds; ++seed) {
            const Pair<float> p = sampler(place % block_side, place / block_side, place % 5, seed).pair(3);
            ++counts[size_t(int(p.x() * cells) * cells + int(p.y() * cells))];
        }
        EXPECT_TRUE(chi_squared_test(counts, expected, sidak(significance, block_side * block_side))) << "place " << place;
    }
}

// The errors of a block tend to cancel; those of each pixel are as large as those of a pixel alone.
TEST(Sampler, ErrorsOfNeighboursCancel) {
    for (const uint32_t n : {1u, 2u, 8u}) {
        Moments pixel, block;
        for (uint32_t seed = 0; seed < 500; ++seed) {
            double sum = 0;
            for (uint32_t place = 0; place < block_side * block_side; ++place) {
                double error = 0;
                for (uint32_t i = 0; i < n; ++i) {
                    const Pair<float> p = sampler(place % block_side, place / block_side, i, seed).pair(2);
                    error += double(p.x() * p.y() < 0.3f) - (0.3 - 0.3 * std::log(0.3));
                }
                if (place == 0) pixel.add(error * error / n);
                sum += error;
            }
            block.add(sum * sum / (n * block_side * block_side));
        }
        EXPECT_LT(block.mean, 0.3 * pixel.mean) << n << " points";
    }
}

TEST(Sampler, BeginsAnotherSequenceAfterTheLastPointOfAPixel) {
    constexpr uint32_t last = (1u << place_shift) - 1;
    EXPECT_EQ(sampler(3, 5, last).key, sampler(3, 5, 0).key);
    EXPECT_NE(sampler(3, 5, last + 1).key, sampler(3, 5, 0).key);
    EXPECT_EQ(sampler(3, 5, last + 1).index, sampler(3, 5, 0).index);
    EXPECT_TRUE(is_net(3, 5, 1, last + 1, 6));
}

TEST(Sampler, IsAFunctionOfItsKeyAndStaysBelowOne) {
    for (uint32_t i = 0; i < 100'000; ++i) {
        const Pair<float> a = sampler(i % 100, i / 100, i).pair(i % 31), b = sampler(i % 100, i / 100, i).pair(i % 31);
        ASSERT_EQ(a.bits_x, b.bits_x);
        ASSERT_EQ(a.bits_y, b.bits_y);
        ASSERT_TRUE(a.x() >= 0 && a.x() < 1 && a.y() >= 0 && a.y() < 1);
    }
    EXPECT_LT(unit_float<float>(0xffffffffu), 1.f);
    EXPECT_EQ(unit_float<float>(0u), 0.f);
}

TEST(Sampler, LargeIndicesAreStratified) {
    std::vector<int64_t> counts(256);
    for (uint32_t i = 0; i < 256; ++i) counts[sampler(3, 5, 0xffffff00u + i).pair(2).bits_x >> 24]++;
    for (const int64_t c : counts) EXPECT_EQ(c, 1);
}

// Across blocks the coordinates are independent random numbers: all pairs of them fill a grid evenly.
TEST(Sampler, BlocksDimensionsSeedsAndHalvesAreIndependent) {
    constexpr int cells = 16, size = 256;
    struct Case {
        const char* name;
        std::function<std::array<float, 2>(uint32_t x, uint32_t y)> draw;
    };
    const std::vector<Case> cases = {
        {"x and y of one pair",
         [](uint32_t x, uint32_t y) {
             return std::array{sampler(x, y, 0).pair(0).x(), sampler(x, y, 0).pair(0).y()};
         }},
        {"two dimensions",
         [](uint32_t x, uint32_t y) {
             return std::array{sampler(x, y, 0).pair(0).x(), sampler(x, y, 0).pair(1).x()};
         }},
        {"distant dimensions",
         [](uint32_t x, uint32_t y) {
             return std::array{sampler(x, y, 3).pair(2).y(), sampler(x, y, 3).pair(90).x()};
         }},
        {"neighbours in x",
         [](uint32_t x, uint32_t y) {
             return std::array{sampler(2 * block_side * x, y, 0).pair(0).x(), sampler(2 * block_side * x + block_side, y, 0).pair(0).x()};
         }},
        {"neighbours in y",
         [](uint32_t x, uint32_t y) {
             return std::array{sampler(x, 2 * block_side * y, 5).pair(1).y(), sampler(x, 2 * block_side * y + block_side, 5).pair(1).y()};
         }},
        {"mirror pixels",
         [](uint32_t x, uint32_t y) {
             return std::array{sampler(x, y + 256, 0).pair(0).x(), sampler(y + 256, x, 0).pair(0).x()};
         }},
        {"distant samples",
         [](uint32_t x, uint32_t y) {
             const Sampler<float> near = sampler(block_side * x, block_side * y, 1),
                                  far = sampler(block_side * x, block_side * y, 1'000'003);
             return std::array{near.pair(0).x(), far.pair(0).x()};
         }},
        {"seeds",
         [](uint32_t x, uint32_t y) {
             return std::array{sampler(x, y, 0, 1).pair(0).x(), sampler(x, y, 0, 2).pair(0).x()};
         }},
        {"independent samples",
         [](uint32_t x, uint32_t y) {
             return std::array{independent(3, 5, 2 * (256 * y + x)).pair(0).x(), independent(3, 5, 2 * (256 * y + x) + 1).pair(0).x()};
         }},
        {"x and y of one pair of an independent sample",
         [](uint32_t x, uint32_t y) {
             return std::array{independent(3, 5, 256 * y + x).pair(4).x(), independent(3, 5, 256 * y + x).pair(4).y()};
         }},
        {"two dimensions of an independent sample",
         [](uint32_t x, uint32_t y) {
             return std::array{independent(3, 5, 256 * y + x).pair(0).y(), independent(3, 5, 256 * y + x).pair(1).y()};
         }},
        {"an independent sample of two pixels",
         [](uint32_t x, uint32_t y) {
             return std::array{independent(x, y, 9).pair(0).x(), independent(x + 256, y, 9).pair(0).x()};
         }},
        {"halves", [](uint32_t x, uint32_t y) {
             const auto a = pixel_sampler<float>(x, y, randomisation(7, 0), 0), b = pixel_sampler<float>(x, y, randomisation(7, 1), 0);
             return std::array{a.pair(0).x(), b.pair(0).x()};
         }}};
    const std::vector<double> expected(cells * cells, double(size * size) / (cells * cells));
    for (const Case& c : cases) {
        std::vector<int64_t> counts(cells * cells);
        for (uint32_t y = 0; y < size; ++y)
            for (uint32_t x = 0; x < size; ++x) {
                const auto [u, v] = c.draw(x, y);
                ++counts[size_t(int(u * cells) * cells + int(v * cells))];
            }
        EXPECT_TRUE(chi_squared_test(counts, expected, sidak(significance, int64_t(cases.size())))) << c.name;
    }
}

// Within a pixel the points of different dimensions are nets, shuffled against each other: their correlation averages to 0.
TEST(Sampler, DimensionsOfAPixelAreUncorrelated) {
    Moments correlation;
    for (uint32_t pixel = 0; pixel < 2000; ++pixel) {
        double sum = 0;
        for (uint32_t i = 0; i < 64; ++i) {
            const Sampler<float> s = sampler(pixel * block_side, 0, i);
            sum += (s.pair(0).x() - 0.5) * (s.pair(1).x() - 0.5);
        }
        correlation.add(sum / 64 * 12);
    }
    EXPECT_TRUE(z_test(correlation, 0));
    // Independent points would have variance 1 / 64. The shuffle of indices is nested, so that points stay in pairs: at worst half
    // of them are independent.
    EXPECT_LT(correlation.variance(), 2.0 / 64);
}

// Means of n independent numbers have variance 1 / (12 n); stratified points have less.
TEST(Sampler, IndependentSamplesHaveRandomVariance) {
    constexpr uint32_t n = 64, pixels = 4000;
    Moments squares, of_points;
    for (uint32_t pixel = 0; pixel < pixels; ++pixel) {
        double sum = 0, points = 0;
        for (uint32_t i = 0; i < n; ++i) {
            sum += independent(pixel, 1, i).pair(2).x() - 0.5;
            points += sampler(pixel * block_side, 1, i).pair(2).x() - 0.5;
        }
        squares.add(sum * sum / n * 12);
        of_points.add(points * points / n * 12);
    }
    EXPECT_TRUE(z_test(squares, 1));
    EXPECT_LT(of_points.mean, 0.1);
}

TEST(Sampler, LanesEqualOnePathBitForBit) {
    std::mt19937 random(3);
    for (int round = 0; round < 2000; ++round) {
        uint32_t key[64], index[64];
        for (int i = 0; i < 64; ++i) key[i] = uint32_t(random()), index[i] = uint32_t(random()) >> (random() % 32);
        const Pair<Wide> wide = Sampler<Wide>{load<WideUInt>(key), load<WideUInt>(index)}.pair(uint32_t(round));
        const Sampler<Wide> samplers =
            pixel_sampler<Wide>(load<WideUInt>(key), load<WideUInt>(index), WideUInt(5u), load<WideUInt>(index) ^ 1u);
        for (int i = 0; i < width<Wide>; ++i) {
            const Pair<float> one = Sampler<float>{key[i], index[i]}.pair(uint32_t(round));
            ASSERT_EQ(one.bits_x, lane(wide.bits_x, i));
            ASSERT_EQ(one.bits_y, lane(wide.bits_y, i));
            ASSERT_EQ(one.x(), lane(wide.x(), i));
            const Sampler<float> pixel = pixel_sampler<float>(key[i], index[i], 5u, index[i] ^ 1u);
            ASSERT_EQ(pixel.key, lane(samplers.key, i));
            ASSERT_EQ(pixel.index, lane(samplers.index, i));
        }
    }
}

} // namespace blush::TEST_FILE
