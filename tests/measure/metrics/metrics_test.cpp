#include "measure/metrics/metrics.h"
#include "tests/measure/metrics/images.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace blush::TEST_FILE {
namespace {

using test::constant_image;
using test::random_image;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

TEST(Compare, EqualImagesDifferInNothing) {
    const RgbImage image = random_image(17, 9, 1, 3);
    for (const Encoding encoding : {Encoding::scene_linear, Encoding::display}) {
        const Metrics m = *compare(image, image, encoding);
        EXPECT_EQ(m.mse, 0);
        EXPECT_EQ(m.rmse, 0);
        EXPECT_EQ(m.relmse, 0);
        EXPECT_EQ(m.mae, 0);
        EXPECT_EQ(m.max_abs, 0);
        EXPECT_EQ(m.flip.mean, 0);
        EXPECT_EQ(m.psnr, std::numeric_limits<double>::infinity());
        EXPECT_EQ(m.mean_a, m.mean_b);
    }
}

// Two pixels by hand: differences 1, 0, -0.5 and 0, 0, 0.25.
TEST(Compare, ByHand) {
    const RgbImage a{2, 1, {{2, 1, 0}, {0, 0, 0.5f}}};
    const RgbImage b{2, 1, {{1, 1, 0.5f}, {0, 0, 0.25f}}};
    const Metrics m = *compare(a, b, Encoding::scene_linear);
    const double squared = 1 + 0.25 + 0.0625;
    EXPECT_DOUBLE_EQ(m.mse, squared / 6);
    EXPECT_DOUBLE_EQ(m.rmse, std::sqrt(squared / 6));
    EXPECT_DOUBLE_EQ(m.relmse, (1 / 1.01 + 0.25 / 0.26 + 0.0625 / 0.0725) / 6);
    EXPECT_DOUBLE_EQ(m.mae, 1.75 / 6);
    EXPECT_DOUBLE_EQ(m.max_abs, 1);
    EXPECT_EQ(m.mean_a, (std::array<double, 3>{1, 0.5, 0.25}));
    EXPECT_EQ(m.mean_b, (std::array<double, 3>{0.5, 0.5, 0.375}));
    EXPECT_EQ(m.nonfinite_a + m.nonfinite_b, 0);
    // PSNR sees 2 clamped to 1, and the sRGB encoding of the rest.
    const auto srgb = [](double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; };
    const double seen = std::pow(srgb(0.5), 2) + std::pow(srgb(0.5) - srgb(0.25), 2);
    EXPECT_NEAR(m.psnr, -10 * std::log10(seen / 6), 1e-5);
}

TEST(Compare, PsnrOfDisplayImagesIsOfTheirOwnValues) {
    const Metrics m = *compare(constant_image(4, 4, {0.5f, 0.5f, 0.5f}), constant_image(4, 4, {0.6f, 0.6f, 0.6f}), Encoding::display);
    EXPECT_NEAR(m.psnr, 20, 1e-5);
}

TEST(Compare, TheSecondImageIsTheReference) {
    const RgbImage dark = constant_image(4, 4, {0.1f, 0.1f, 0.1f}), bright = constant_image(4, 4, {1, 1, 1});
    EXPECT_GT(compare(bright, dark, Encoding::scene_linear)->relmse, compare(dark, bright, Encoding::scene_linear)->relmse);
}

TEST(Compare, PixelsThatAreNotFiniteAreCountedAndLeftOut) {
    RgbImage a = random_image(40, 40, 2), b = random_image(40, 40, 3);
    const RgbImage without_a = a, without_b = b;
    a.pixels[5].y = nan;
    a.pixels[77] = {infinite, 0, 0};
    b.pixels[77].z = -infinite;
    b.pixels[100] = {nan, nan, nan};
    const Metrics m = *compare(a, b, Encoding::scene_linear);
    EXPECT_EQ(m.nonfinite_a, 2);
    EXPECT_EQ(m.nonfinite_b, 2);
    double squared = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        if (i == 5 || i == 77 || i == 100) continue;
        squared += std::pow(double(without_a.pixels[i].x) - without_b.pixels[i].x, 2);
        squared += std::pow(double(without_a.pixels[i].y) - without_b.pixels[i].y, 2);
        squared += std::pow(double(without_a.pixels[i].z) - without_b.pixels[i].z, 2);
    }
    EXPECT_NEAR(m.mse, squared / (3.0 * (40 * 40 - 3)), 1e-12);
    EXPECT_GT(m.flip.mean, 0);
    EXPECT_LE(m.flip.mean, 1);
}

TEST(Compare, NanInBothImagesIsNoDifference) {
    RgbImage a = random_image(20, 20, 4);
    a.pixels[7].x = nan;
    const Metrics m = *compare(a, a, Encoding::scene_linear);
    EXPECT_EQ(m.flip.mean, 0);
    EXPECT_EQ(m.mse, 0);
    EXPECT_EQ(m.nonfinite_a, 1);
}

TEST(Compare, RefusesIncomparableImages) {
    EXPECT_EQ(compare(constant_image(4, 3, {}), constant_image(3, 4, {}), Encoding::display).error().text(),
              "the images differ in size: 4x3 and 3x4");
    EXPECT_FALSE(compare(constant_image(4, 3, {nan, 0, 0}), constant_image(4, 3, {}), Encoding::display));
}

TEST(Compare, DoesNotDependOnThreads) {
    const RgbImage a = random_image(64, 500, 5), b = random_image(64, 500, 6);
    const Metrics first = *compare(a, b, Encoding::display);
    for (int i = 0; i < 5; ++i) {
        const Metrics again = *compare(a, b, Encoding::display);
        EXPECT_EQ(again.mse, first.mse);
        EXPECT_EQ(again.flip.mean, first.flip.mean);
    }
}

} // namespace
} // namespace blush::TEST_FILE
