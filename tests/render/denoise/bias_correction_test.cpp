#include "render/denoise/bias_correction.h"

#include "core/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace blush::TEST_FILE {
namespace {

constexpr float scale = 0.36f; // exposure scale

// What was rendered in two halves, and what a network might make of it.
struct Image {
    Image(int w, int h) : width(w), height(h), rendered(values(), 1.f), denoised(rendered), halves(pixels(), Vec3{0, 0, 0}) {}
    size_t pixels() const { return size_t(width) * size_t(height); }
    size_t values() const { return 3 * pixels(); }
    // Rendered: the truth plus the mean of the noise of both halves.
    void add_noise(const std::function<float()>& noise) {
        for (size_t i = 0; i < pixels(); ++i) {
            float half[3];
            for (size_t c = 0; c < 3; ++c) {
                const float a = noise(), b = noise();
                rendered[3 * i + c] += (a + b) / 2;
                half[c] = (a - b) / 2;
            }
            halves[i] = {half[0], half[1], half[2]};
        }
    }
    std::vector<float> corrected(const Workers* workers = nullptr, float exposure_scale = scale) const {
        std::vector<float> rgb = denoised;
        correct_bias(rgb, {rendered, 3}, halves, width, height, exposure_scale, workers);
        return rgb;
    }

    int width, height;
    std::vector<float> rendered, denoised;
    std::vector<Vec3> halves;
};

std::function<float()> normal(float deviation, uint32_t seed) {
    return [noise = std::normal_distribution<float>(0, deviation), bits = std::mt19937(seed)]() mutable { return noise(bits); };
}

double mean_square_of_difference(const std::vector<float>& a, float b) {
    double sum = 0;
    for (const float v : a) sum += double(v - b) * double(v - b);
    return sum / double(a.size());
}

TEST(BiasCorrection, WithoutNoiseItRestoresTheRenderedImage) {
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {3, 40}, {17, 18}, {64, 33}, {101, 67}}) {
        Image image(width, height);
        for (size_t i = 0; i < image.values(); ++i) {
            image.rendered[i] = float(i % 7) * (i % 1000 < 20 ? 5000.f : 0.2f);
            image.denoised[i] = float(i % 5) * 0.3f;
        }
        const std::vector<float> rgb = image.corrected();
        // Rounding of the largest values: they predict those beside them.
        for (size_t i = 0; i < rgb.size(); ++i) ASSERT_NEAR(rgb[i], image.rendered[i], 6 * 5000 * 0x1p-22f) << width << " " << i;
    }
}

// b^2 / mean d^2 is normal with a deviation of 2 / 7 if there is no bias, so the mean of w^2 is 4 / 49 E[max(0, z - 1)^2] = 0.0061. The
// levels above the finest add 1 / 4 + 1 / 16 + ... of that.
TEST(BiasCorrection, AddsHardlyAnyNoiseWhereThereIsNoBias) {
    Image image(256, 256);
    image.add_noise(normal(0.3f, 1));
    const double before = mean_square_of_difference(image.rendered, 1);
    EXPECT_LT(mean_square_of_difference(image.corrected(), 1), 2 * 0.0061 * 4 / 3 * before);
}

// Every pixel is noisier than the bias, which means of many pixels show.
TEST(BiasCorrection, CorrectsBiasBelowTheNoiseOfAPixel) {
    Image image(256, 256);
    image.add_noise(normal(0.3f, 2));
    for (size_t i = 0; i < image.values(); ++i) image.denoised[i] = (i / 3) % 256 < 128 ? 0.9f : 1.05f;
    const double before = mean_square_of_difference(image.denoised, 1);
    EXPECT_LT(mean_square_of_difference(image.corrected(), 1), 0.2 * before);
    EXPECT_LT(mean_square_of_difference(image.corrected(), 1), 0.1 * mean_square_of_difference(image.rendered, 1));
}

// A bright sample in one half only is no evidence.
TEST(BiasCorrection, FirefliesStayAway) {
    Image image(64, 64);
    image.add_noise(normal(0.01f, 3));
    for (const size_t pixel : {size_t(700), size_t(2000), size_t(2003)})
        for (size_t c = 0; c < 3; ++c) {
            image.rendered[3 * pixel + c] += 5000;
            image.halves[pixel] = {5000, 5000, 5000};
        }
    for (const float v : image.corrected()) ASSERT_NEAR(v, 1, 0.02f);
}

// So is one in both halves, if it is not nearly the same: a single pixel says little.
TEST(BiasCorrection, BrightSamplesInBothHalvesOfAPixelStayAway) {
    Image image(64, 64);
    image.add_noise(normal(0.01f, 7));
    const auto brighten = [&](size_t pixel, float a, float b) {
        for (size_t c = 0; c < 3; ++c) image.rendered[3 * pixel + c] += (a + b) / 2;
        image.halves[pixel] = {(a - b) / 2, (a - b) / 2, (a - b) / 2};
    };
    brighten(700, 50, 30);
    brighten(2000, 20, 25);
    for (const float v : image.corrected()) ASSERT_NEAR(v, 1, 0.02f);
    // A highlight of many pixels is there.
    for (const size_t y : {40, 41, 42, 43, 44})
        for (const size_t x : {40, 41, 42, 43, 44}) brighten(64 * y + x, 20 + float(x % 3), 20 + float(y % 3));
    EXPECT_GT(image.corrected()[3 * (64 * 42 + 42)], 15);
}

// Noise that is alike in blocks of pixels, as path reuse may leave it, is no bias to the levels that average it: their half differences
// keep their sign.
TEST(BiasCorrection, CorrelatedNoiseIsNotTakenForBiasByCoarserLevels) {
    constexpr int block = 8, side = 256;
    Image image(side, side), coarse(side / block, side / block);
    coarse.add_noise(normal(0.3f, 4));
    for (size_t i = 0; i < image.pixels(); ++i) {
        const size_t from = (i / side / block) * (side / block) + i % side / block;
        for (size_t c = 0; c < 3; ++c) image.rendered[3 * i + c] = coarse.rendered[3 * from + c];
        image.halves[i] = coarse.halves[from];
    }
    // At most what a window within one block lets through: E[w^2 d^2] for normal d and h and w = max(0, d^2 - h^2 - 2 / 7 |d h|) / d^2.
    // If the coarser levels took it for independent noise, they would let nearly all of it through.
    EXPECT_LT(mean_square_of_difference(image.corrected(), 1), 0.45 * mean_square_of_difference(image.rendered, 1));
}

TEST(BiasCorrection, DoesNotDependOnTheScaleOfLight) {
    Image image(40, 30);
    image.add_noise(normal(0.2f, 5));
    for (size_t i = 0; i < image.values(); ++i) image.denoised[i] = 0.8f;
    const std::vector<float> plain = image.corrected();
    for (const float factor : {1e-12f, 1e6f}) {
        Image other = image;
        for (auto* plane : {&other.rendered, &other.denoised})
            for (float& v : *plane) v *= factor;
        for (Vec3& h : other.halves) h = {h.x * factor, h.y * factor, h.z * factor};
        const std::vector<float> rgb = other.corrected(nullptr, scale / factor);
        for (size_t i = 0; i < rgb.size(); ++i) ASSERT_NEAR(rgb[i] / factor, plain[i], 1e-4f);
    }
}

TEST(BiasCorrection, StaysFiniteAndLeavesPixelsThatAreNot) {
    constexpr float infinite = std::numeric_limits<float>::infinity(), none = std::numeric_limits<float>::quiet_NaN();
    Image image(50, 40);
    const std::vector<float> strange{none, infinite, -infinite, 3e38f, -3e38f, 1e-42f, 0, 65504};
    for (size_t i = 0; i < image.values(); ++i) {
        image.rendered[i] = strange[i % 8];
        image.denoised[i] = i % 11 < 3 ? 0 : i % 11 < 6 ? 3e37f : 1e-40f;
    }
    for (size_t i = 0; i < image.pixels(); ++i) image.halves[i] = {strange[i % 5], strange[i % 7], 1};
    for (const float exposure_scale : {1e-30f, 1.f, 1e30f})
        for (const float v : image.corrected(nullptr, exposure_scale)) ASSERT_TRUE(std::isfinite(v) && v >= 0) << exposure_scale;

    Image unknown(8, 8);
    unknown.rendered.assign(unknown.values(), 2);
    unknown.halves.assign(unknown.pixels(), Vec3{none, none, none});
    EXPECT_EQ(unknown.corrected(), unknown.denoised) << "no second half";
}

TEST(BiasCorrection, DoesNotDependOnTheNumberOfThreads) {
    Image image(123, 77);
    image.add_noise(normal(0.5f, 6));
    for (size_t i = 0; i < image.values(); ++i) image.denoised[i] = 0.5f + float(i % 13) * 0.1f;
    const Workers two(2), three(3);
    EXPECT_EQ(image.corrected(&two), image.corrected());
    EXPECT_EQ(image.corrected(&three), image.corrected());
}

} // namespace
} // namespace blush::TEST_FILE
