// The bias test on pictures made of known noise and known bias.
#include "measure/bias_test.h"
#include "statistics.h"

#include <random>

namespace blush::test {
namespace {

using namespace statistics;

constexpr int side = 64;

// Grey `level(x, y)` with normal noise of standard deviation `sigma` per pixel.
template <class Level> MeasuredImage noisy(std::mt19937& bits, float sigma, int64_t samples, Level level) {
    std::normal_distribution<float> normal(0, sigma);
    MeasuredImage m;
    m.image = {side, side, {}};
    m.samples = samples;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const float v = level(x, y) + normal(bits);
            m.image.pixels.push_back({v, v, v});
            m.error.push_back({sigma, sigma, sigma});
        }
    }
    return m;
}
float even(int, int) { return 0.5f; }

TEST(BiasTest, CallsRightPicturesBiasedAsOftenAsItSays) {
    std::mt19937 bits(1);
    Moments wrong;
    for (int run = 0; run < 3000; ++run) wrong.add(test_bias(noisy(bits, 0.1f, 16, even), noisy(bits, 0.025f, 256, even)).biased);
    EXPECT_TRUE(z_test(wrong, bias_significance));
}

TEST(BiasTest, SeesTwoPercentMissingEverywhereAndSaysHowMuch) {
    std::mt19937 bits(2);
    const BiasTest t = test_bias(noisy(bits, 0.1f, 16, [](int, int) { return 0.49f; }), noisy(bits, 0.025f, 256, even));
    EXPECT_TRUE(t.biased);
    EXPECT_EQ(t.verdict(), "biased");
    EXPECT_NEAR(t.whole.percent(), -2, 100 * 3 * t.whole.error / 0.5);
    EXPECT_LT(t.whole.z(), -5);
}

// Too little for the whole picture's mean, but not for the region's.
TEST(BiasTest, SeesACornerThatIsWrong) {
    std::mt19937 bits(3);
    const auto corner = [](int x, int y) { return x < 16 && y < 16 ? 0.6f : 0.5f; };
    const BiasTest t = test_bias(noisy(bits, 0.1f, 16, corner), noisy(bits, 0.025f, 256, even));
    EXPECT_TRUE(t.biased);
    EXPECT_EQ(t.worst.x, 0);
    EXPECT_EQ(t.worst.y, 0);
    EXPECT_EQ(t.worst.width, 16);
    EXPECT_EQ(t.regions.size(), 16u);
}

TEST(BiasTest, PicturesWithoutNoiseMayDifferByRoundingAlone) {
    std::mt19937 bits(4);
    const MeasuredImage exact = noisy(bits, 0, 16, even);
    EXPECT_FALSE(test_bias(exact, exact).biased);
    EXPECT_FALSE(test_bias(noisy(bits, 0, 16, [](int, int) { return 0.500001f; }), exact).biased);
    EXPECT_TRUE(test_bias(noisy(bits, 0, 16, [](int, int) { return 0.501f; }), exact).biased);
}

// A picture that has not met the rare bright samples yet does not know its own noise; the reference does.
TEST(BiasTest, APictureThatMissedRareLightIsNotCalledWrong) {
    std::mt19937 bits(5);
    const MeasuredImage missed = noisy(bits, 0.001f, 16, [](int, int) { return 0.497f; });
    EXPECT_FALSE(test_bias(missed, noisy(bits, 0.05f, 256, even)).biased);
    EXPECT_TRUE(test_bias(missed, noisy(bits, 0.001f, 256, even)).biased);
}

// Light that one pixel in two hundred has met, all of it: much of what there was to be met may be missing by chance.
TEST(BiasTest, FewBrightPixelsAreNoEvidence) {
    std::mt19937 bits(8);
    const MeasuredImage reference = noisy(bits, 0.01f, 8'000'000, even); // as noisy as the pictures, but for its samples
    Moments wrong;
    std::bernoulli_distribution met(0.005);
    for (int run = 0; run < 500; ++run) {
        MeasuredImage image = noisy(bits, 0, 16, [](int, int) { return 0.f; });
        for (size_t i = 0; i < image.image.pixels.size(); ++i) {
            if (!met(bits)) continue;
            image.image.pixels[i] = {100, 100, 100}; // 0.5 / 0.005
            image.error[i] = {100, 100, 100};        // the other half has met none
        }
        wrong.add(test_bias(image, reference).biased);
    }
    EXPECT_TRUE(z_test_at_most(wrong, bias_significance));
}

TEST(BiasTest, MergingWeighsBySamples) {
    std::mt19937 bits(6);
    const MeasuredImage a = noisy(bits, 0, 10, [](int, int) { return 1.f; }), b = noisy(bits, 0, 30, [](int, int) { return 2.f; });
    const MeasuredImage m = merged(a, b);
    EXPECT_EQ(m.samples, 40);
    EXPECT_FLOAT_EQ(m.image.pixels[0].x, 1.75f);
    EXPECT_EQ(merged({}, b).samples, 30);
}

TEST(BiasTest, DifferentSizesGiveNoVerdict) {
    std::mt19937 bits(7);
    EXPECT_TRUE(test_bias(noisy(bits, 0.1f, 16, even), {}).regions.empty());
}

} // namespace
} // namespace blush::test
