// The bias test on synthetic images of known noise and bias.
#include "measure/statistics/bias_test.h"
#include "measure/statistics/significance.h"
#include "tests/support/statistics.h"

#include <algorithm>
#include <array>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr int side = 64;

// Grey `level(x, y)` with normal noise of standard deviation `sigma(x, y)` per pixel.
template <class Sigma, class Level> MeasuredImage unevenly_noisy(std::mt19937& bits, int64_t samples, Sigma sigma, Level level) {
    std::normal_distribution<float> normal;
    MeasuredImage m;
    m.image = {side, side, {}};
    m.samples = samples;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const float error = sigma(x, y), v = level(x, y) + error * normal(bits);
            m.image.pixels.push_back({v, v, v});
            m.error.push_back({error, error, error});
        }
    }
    return m;
}
template <class Level> MeasuredImage noisy(std::mt19937& bits, float sigma, int64_t samples, Level level) {
    return unevenly_noisy(
        bits, samples, [sigma](int, int) { return sigma; }, level);
}
float even(int, int) { return 0.5f; }

// Light of 0.05 in the mean over the image that arrives in about 48 of its 4,096 pixels.
void add_rare_light(std::mt19937& bits, MeasuredImage& image) {
    constexpr int events = 3 * 16;
    constexpr float bright = 0.05f * side * side / events;
    std::poisson_distribution<int> count(events);
    std::uniform_int_distribution<size_t> place(0, size_t(side) * side - 1);
    for (int left = count(bits); left > 0; --left) {
        const size_t i = place(bits);
        Vec3& pixel = image.image.pixels[i];
        pixel = {pixel.x + bright, pixel.y + bright, pixel.z + bright};
        image.error[i] = {bright, bright, bright};
    }
}

// Lower, as the variance of a region is the largest of three estimates: 0.7 % in 15,000 runs.
TEST(BiasTest, FalseAlarmRateIsAtMostTheStatedLevel) {
    std::mt19937 bits(1);
    Moments alarms, others;
    for (int run = 0; run < 3000; ++run) {
        const MeasuredImage image = noisy(bits, 0.1f, 16, even), reference = noisy(bits, 0.025f, 256, even);
        const bool alarm = test_bias(image, reference).biased;
        alarms.add(alarm);
        others.add(!alarm);
    }
    EXPECT_TRUE(z_test_at_most(alarms, bias_significance));
    EXPECT_TRUE(z_test_at_most(others, 1 - bias_significance / 2)) << "too few alarms";
}

TEST(BiasTest, DetectsTwoPercentGlobalBias) {
    std::mt19937 bits(2);
    const BiasTest t = test_bias(noisy(bits, 0.1f, 16, [](int, int) { return 0.49f; }), noisy(bits, 0.025f, 256, even));
    EXPECT_TRUE(t.biased);
    EXPECT_EQ(t.verdict(), "biased");
    EXPECT_NEAR(t.whole.percent(), -2, 100 * 3 * t.whole.error / 0.5);
    EXPECT_LT(t.whole.z(), -5);
}

// A light in a corner whose edge is noisier than the rest of the image hides a global bias of 1 %, except from the pooled test,
// whose false alarm rate does not increase.
TEST(BiasTest, DetectsGlobalBiasBesideANoisyLight) {
    std::mt19937 bits(12);
    const auto with_lamp = [&](float level, float noise, int64_t samples) {
        const auto at_lamp = [](int x, int y) { return x < 16 && y < 16; };
        return unevenly_noisy(
            bits, samples, [&](int x, int y) { return at_lamp(x, y) ? 20 * noise : noise; },
            [&](int x, int y) { return at_lamp(x, y) ? 10 : level; });
    };
    constexpr int runs = 1000;
    Moments wrong;
    int found = 0, found_without = 0;
    for (int run = 0; run < runs; ++run) {
        const MeasuredImage reference = with_lamp(0.5f, 0.01f, 1600);
        wrong.add(test_bias(with_lamp(0.5f, 0.1f, 16), reference).biased);
        const BiasTest darker = test_bias(with_lamp(0.49f, 0.1f, 16), reference);
        found += darker.biased;
        const auto shows = [&](const RegionBias& r) { return std::abs(r.z()) > darker.threshold; };
        found_without += shows(darker.whole) || std::ranges::any_of(darker.regions, shows);
    }
    EXPECT_TRUE(z_test_at_most(wrong, bias_significance));
    EXPECT_GT(found, runs * 19 / 20);
    EXPECT_LT(found_without, runs / 2) << "otherwise the light would not hide the bias";
}

// Not significant for the whole image, but for the region.
TEST(BiasTest, DetectsLocalBias) {
    std::mt19937 bits(3);
    const auto corner = [](int x, int y) { return x < 16 && y < 16 ? 0.6f : 0.5f; };
    const BiasTest t = test_bias(noisy(bits, 0.1f, 16, corner), noisy(bits, 0.025f, 256, even));
    EXPECT_TRUE(t.biased);
    EXPECT_EQ(t.worst.x, 0);
    EXPECT_EQ(t.worst.y, 0);
    EXPECT_EQ(t.worst.width, 16);
    EXPECT_EQ(t.regions.size(), 16u);
}

TEST(BiasTest, NoiseFreeImagesMayDifferByRounding) {
    std::mt19937 bits(4);
    const MeasuredImage exact = noisy(bits, 0, 16, even);
    EXPECT_FALSE(test_bias(exact, exact).biased);
    EXPECT_FALSE(test_bias(noisy(bits, 0, 16, [](int, int) { return 0.500001f; }), exact).biased);
    EXPECT_TRUE(test_bias(noisy(bits, 0, 16, [](int, int) { return 0.501f; }), exact).biased);
}

// An image without rare bright samples underestimates its noise; the reference does not.
TEST(BiasTest, MissedRareLightIsNotBias) {
    std::mt19937 bits(5);
    const MeasuredImage missed = noisy(bits, 0.001f, 16, [](int, int) { return 0.497f; });
    EXPECT_FALSE(test_bias(missed, noisy(bits, 0.05f, 256, even)).biased);
    EXPECT_TRUE(test_bias(missed, noisy(bits, 0.001f, 256, even)).biased);
}

// All light is in one pixel of two hundred: much of it may be missing by chance.
TEST(BiasTest, FewBrightPixelsAreNotSignificant) {
    std::mt19937 bits(8);
    const MeasuredImage reference = noisy(bits, 0.01f, 8'000'000, even); // noise as of the images, scaled by its samples
    Moments wrong;
    std::bernoulli_distribution met(0.005);
    for (int run = 0; run < 500; ++run) {
        MeasuredImage image = noisy(bits, 0, 16, [](int, int) { return 0.f; });
        for (size_t i = 0; i < image.image.pixels.size(); ++i) {
            if (!met(bits)) continue;
            image.image.pixels[i] = {100, 100, 100}; // 0.5 / 0.005
            image.error[i] = {100, 100, 100};        // the other half buffer has none
        }
        wrong.add(test_bias(image, reference).biased);
    }
    EXPECT_TRUE(z_test_at_most(wrong, bias_significance));
}

// Light in three pixels of a region on average and in none of many regions: these are 10 % too dark, with almost no visible
// noise.
TEST(BiasTest, RareBrightLightThatIsMissingIsNotBias) {
    std::mt19937 bits(9);
    const MeasuredImage reference = noisy(bits, 0.001f, 100'000, [](int, int) { return 0.55f; });
    Moments wrong;
    for (int run = 0; run < 500; ++run) {
        MeasuredImage image = noisy(bits, 0.02f, 64, even);
        add_rare_light(bits, image);
        wrong.add(test_bias(image, reference).biased);
    }
    EXPECT_TRUE(z_test_at_most(wrong, bias_significance));
}

// The same with both exchanged: the reference has missed the light, and the image is no better known.
TEST(BiasTest, RareBrightLightThatTheReferenceMissesIsNotBias) {
    std::mt19937 bits(11);
    Moments wrong;
    for (int run = 0; run < 500; ++run) {
        MeasuredImage reference = noisy(bits, 0.02f, 64, even);
        add_rare_light(bits, reference);
        wrong.add(test_bias(noisy(bits, 0.001f, 64, [](int, int) { return 0.55f; }), reference).biased);
    }
    EXPECT_TRUE(z_test_at_most(wrong, bias_significance));
}

// One pixel in which an image has nothing and the reference by chance a
// firefly, of which its own error knows nothing.
TEST(BiasTest, OnePixelIsNotSignificant) {
    std::mt19937 bits(10);
    MeasuredImage reference = noisy(bits, 0.001f, 256, even);
    reference.image.pixels[500] = {1.5f, 1.5f, 1.5f};
    const BiasTest t = test_bias(noisy(bits, 0.004f, 16, even), reference);
    EXPECT_FALSE(t.biased) << t.worst.z();
}

// Groups of 16 fully correlated pixels: treating them as independent gives far too many false alarms.
TEST(BiasTest, CorrelatedPixelsAreAccountedFor) {
    std::mt19937 bits(11);
    const auto in_groups = [&](double variance_factor) {
        std::array<float, side * side / 16> common;
        std::normal_distribution<float> normal(0, 0.1f);
        for (float& c : common) c = normal(bits);
        MeasuredImage m = noisy(bits, 0, 16, [&](int x, int y) { return 0.5f + common[size_t(y / 4 * (side / 4) + x / 4)]; });
        m.error.assign(m.error.size(), {0.1f, 0.1f, 0.1f});
        m.variance_factor = variance_factor;
        return m;
    };
    Moments honest, naive;
    for (int run = 0; run < 500; ++run) {
        const MeasuredImage reference = noisy(bits, 0.001f, 4096, even);
        honest.add(test_bias(in_groups(16), reference).biased);
        naive.add(test_bias(in_groups(1), reference).biased);
    }
    EXPECT_TRUE(z_test_at_most(honest, bias_significance));
    EXPECT_GT(naive.mean, 0.5);
}

TEST(Significance, DeviatesMatchStudentsT) {
    // Two-sided quantiles of Student's distribution: 5 % with 10 and 30, 0.1 %
    // with 20 degrees of freedom.
    EXPECT_NEAR(normal_deviate(2.2281, 10), 1.96, 0.01);
    EXPECT_NEAR(normal_deviate(-2.0423, 30), -1.96, 0.005);
    EXPECT_NEAR(normal_deviate(3.8495, 20), 3.2905, 0.02);
    EXPECT_EQ(normal_deviate(5, 0), 0);
    EXPECT_NEAR(significant_deviate(10, 1 - std::pow(0.95, 10)), 1.96, 0.001) << "ten tests at 5 % each";
}

TEST(BiasTest, MergingWeighsBySamples) {
    std::mt19937 bits(6);
    const MeasuredImage a = noisy(bits, 0, 10, [](int, int) { return 1.f; }), b = noisy(bits, 0, 30, [](int, int) { return 2.f; });
    const MeasuredImage m = merged(a, b);
    EXPECT_EQ(m.samples, 40);
    EXPECT_FLOAT_EQ(m.image.pixels[0].x, 1.75f);
    EXPECT_EQ(merged({}, b).samples, 30);
}

TEST(BiasTest, DifferentSizesGiveAnEmptyResult) {
    std::mt19937 bits(7);
    EXPECT_TRUE(test_bias(noisy(bits, 0.1f, 16, even), {}).regions.empty());
}

} // namespace
} // namespace blush::test::TEST_FILE
