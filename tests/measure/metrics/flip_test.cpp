// FLIP against a second implementation: the papers' formulas in double, with full two-dimensional kernels, no separation, no threads.
#include "measure/metrics/flip.h"
#include "tests/measure/metrics/images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace blush::TEST_FILE {
namespace {

using test::constant_image;
using test::random_image;

// ---- the second implementation

namespace slow {

using Color = std::array<double, 3>;
using Channel = std::vector<double>;
constexpr double pi = std::numbers::pi;
constexpr double ppd = 3840 * pi / 180;

double to_linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

Color multiply(const std::array<Color, 3>& m, const Color& c) {
    Color r{};
    for (size_t i = 0; i < 3; ++i) r[i] = m[i][0] * c[0] + m[i][1] * c[1] + m[i][2] * c[2];
    return r;
}

// The primaries of Rec.709 with its D65 white of (0.3127, 0.3290), and the inverse by Cramer's rule.
const std::array<Color, 3> xyz_from_rgb{
    {{0.4123866, 0.3575915, 0.1804505}, {0.2126368, 0.7151830, 0.0721802}, {0.0193306, 0.1191972, 0.9503726}}};

std::array<Color, 3> inverse(const std::array<Color, 3>& m) {
    const auto minor = [&](size_t r, size_t c) {
        const size_t r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    };
    const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    std::array<Color, 3> inv{};
    for (size_t r = 0; r < 3; ++r)
        for (size_t c = 0; c < 3; ++c) inv[r][c] = minor(c, r) / determinant;
    return inv;
}

Color white() { return multiply(xyz_from_rgb, {1, 1, 1}); }

Color opponent(const Color& linear) {
    const Color c = multiply(xyz_from_rgb, linear), w = white();
    const double x = c[0] / w[0], y = c[1] / w[1], z = c[2] / w[2];
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Color linear_of_opponent(const Color& o) {
    const double y = (o[0] + 16) / 116;
    const Color w = white();
    return multiply(inverse(xyz_from_rgb), {(y + o[1] / 500) * w[0], y * w[1], (y - o[2] / 200) * w[2]});
}

Color hunt_lab(const Color& linear) {
    const Color c = multiply(xyz_from_rgb, linear), w = white();
    const auto f = [](double t) { return t > std::pow(6.0 / 29, 3) ? std::cbrt(t) : (29.0 / 6) * (29.0 / 6) / 3 * t + 4.0 / 29; };
    const double x = f(c[0] / w[0]), y = f(c[1] / w[1]), z = f(c[2] / w[2]);
    const double lightness = 116 * y - 16;
    return {lightness, lightness / 100 * 500 * (x - y), lightness / 100 * 200 * (y - z)};
}

double hyab(const Color& a, const Color& b) {
    return std::abs(a[0] - b[0]) + std::sqrt(std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2));
}

double color_error(const Color& lab_a, const Color& lab_b) {
    const double largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), 0.7);
    const double e = std::pow(hyab(lab_a, lab_b), 0.7);
    return e < 0.4 * largest ? 0.95 / (0.4 * largest) * e : 0.95 + (e - 0.4 * largest) / (0.6 * largest) * 0.05;
}

// Correlation with a kernel given as a function of the offset, repeated border.
Channel filter(const Channel& in, int width, int height, int radius, const std::function<double(int, int)>& kernel) {
    Channel out(in.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            for (int j = -radius; j <= radius; ++j)
                for (int i = -radius; i <= radius; ++i)
                    sum += kernel(i, j) * in[size_t(std::clamp(y + j, 0, height - 1) * width + std::clamp(x + i, 0, width - 1))];
            out[size_t(y * width + x)] = sum;
        }
    return out;
}

std::function<double(int, int)> normalized(int radius, const std::function<double(int, int)>& kernel) {
    double positive = 0, negative = 0;
    for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i) (kernel(i, j) > 0 ? positive : negative) += std::abs(kernel(i, j));
    return [=](int i, int j) { return kernel(i, j) / (kernel(i, j) > 0 ? positive : negative); };
}

Channel sensitivity(const Channel& in, int width, int height, double a1, double b1, double a2, double b2) {
    const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
    return filter(in, width, height, radius, normalized(radius, [=](int i, int j) {
                      const double d2 = (i * i + j * j) / (ppd * ppd);
                      return a1 * std::sqrt(pi / b1) * std::exp(-pi * pi * d2 / b1) +
                             a2 * std::sqrt(pi / b2) * std::exp(-pi * pi * d2 / b2);
                  }));
}

Channel strength(const Channel& in, int width, int height, const std::function<double(double, double)>& derivative) {
    const double sigma = 0.5 * 0.082 * ppd;
    const int radius = int(std::ceil(3 * sigma));
    const auto along_x = [=](int i, int j) { return derivative(i, sigma) * std::exp(-(i * i + j * j) / (2 * sigma * sigma)); };
    const Channel x = filter(in, width, height, radius, normalized(radius, along_x));
    const Channel y = filter(in, width, height, radius, normalized(radius, [=](int i, int j) { return along_x(j, i); }));
    Channel result(in.size());
    for (size_t i = 0; i < in.size(); ++i) result[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
    return result;
}

struct Seen {
    std::vector<Color> lab;
    Channel edges, points;
};

Seen see(const RgbImage& image) {
    const int w = image.width, h = image.height;
    Channel y, cx, cz, lightness;
    for (const Vec3& p : image.pixels) {
        const Color o = opponent({to_linear(p.x), to_linear(p.y), to_linear(p.z)});
        y.push_back(o[0]);
        cx.push_back(o[1]);
        cz.push_back(o[2]);
        lightness.push_back((o[0] + 16) / 116);
    }
    Seen seen;
    seen.edges = strength(lightness, w, h, [](double x, double) { return -x; });
    seen.points = strength(lightness, w, h, [](double x, double sigma) { return x * x / (sigma * sigma) - 1; });
    y = sensitivity(y, w, h, 1, 0.0047, 0, 1e-5);
    cx = sensitivity(cx, w, h, 1, 0.0053, 0, 1e-5);
    cz = sensitivity(cz, w, h, 34.1, 0.04, 13.5, 0.025);
    for (size_t i = 0; i < y.size(); ++i) {
        Color c = linear_of_opponent({y[i], cx[i], cz[i]});
        for (double& v : c) v = std::clamp(v, 0.0, 1.0);
        seen.lab.push_back(hunt_lab(c));
    }
    return seen;
}

Channel flip(const RgbImage& reference, const RgbImage& test) {
    const Seen a = see(reference), b = see(test);
    Channel map;
    for (size_t i = 0; i < a.lab.size(); ++i) {
        const double feature = std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
        map.push_back(std::pow(color_error(a.lab[i], b.lab[i]), 1 - std::sqrt(feature / std::sqrt(2.0))));
    }
    return map;
}

} // namespace slow

double mean(const std::vector<float>& map) {
    double sum = 0;
    for (const float v : map) sum += v;
    return sum / double(map.size());
}

RgbImage with_noise(const RgbImage& image, double sigma, unsigned seed) {
    std::mt19937 rng(seed);
    std::normal_distribution<double> n;
    RgbImage noisy = image;
    for (Vec3& p : noisy.pixels) p = {float(p.x + sigma * n(rng)), float(p.y + sigma * n(rng)), float(p.z + sigma * n(rng))};
    return noisy;
}

TEST(Flip, AgreesWithAnIndependentImplementation) {
    for (const auto& [width, height] : {std::pair{31, 18}, {1, 25}, {3, 1}}) {
        const RgbImage reference = random_image(width, height, 1);
        RgbImage test = random_image(width, height, 2);
        std::copy_n(reference.pixels.begin(), reference.pixels.size() / 3, test.pixels.begin());
        const std::vector<float> fast = ldr_flip(reference, test);
        const slow::Channel expected = slow::flip(reference, test);
        for (size_t i = 0; i < fast.size(); ++i) ASSERT_NEAR(fast[i], expected[i], 1e-3) << width << "x" << height << " pixel " << i;
    }
}

TEST(Flip, ConstantColoursByTheColourFormulaAlone) {
    const std::pair<Vec3, Vec3> pairs[] = {{{0.2f, 0.4f, 0.6f}, {0.25f, 0.4f, 0.55f}},
                                           {{0, 0, 0}, {1, 1, 1}},
                                           {{0, 1, 0}, {0, 0, 1}},
                                           {{0.5f, 0.5f, 0.5f}, {0.51f, 0.5f, 0.5f}}};
    for (const auto& [a, b] : pairs) {
        const auto lab = [](const Vec3& c) { return slow::hunt_lab({slow::to_linear(c.x), slow::to_linear(c.y), slow::to_linear(c.z)}); };
        const double expected = slow::color_error(lab(a), lab(b));
        for (const float v : ldr_flip(constant_image(8, 8, a), constant_image(8, 8, b))) EXPECT_NEAR(v, expected, 2e-4);
    }
}

TEST(Flip, GreenAgainstBlueIsTheLargestColourError) {
    for (const float v : ldr_flip(constant_image(4, 4, {0, 1, 0}), constant_image(4, 4, {0, 0, 1}))) EXPECT_FLOAT_EQ(v, 1);
}

TEST(Flip, IsZeroForEqualImagesSymmetricAndWithinItsRange) {
    const RgbImage a = random_image(40, 30, 3), b = random_image(40, 30, 4);
    for (const float v : ldr_flip(a, a)) EXPECT_EQ(v, 0);
    for (const float v : hdr_flip(a, a)) EXPECT_EQ(v, 0);
    const std::vector<float> ab = ldr_flip(a, b);
    EXPECT_EQ(ab, ldr_flip(b, a));
    for (const float v : ab) EXPECT_TRUE(v >= 0 && v <= 1);
    for (const float v : hdr_flip(a, b)) EXPECT_TRUE(v >= 0 && v <= 1);
}

TEST(Flip, GrowsWithNoise) {
    const RgbImage reference = constant_image(64, 64, {0.4f, 0.5f, 0.3f});
    double last_ldr = 0, last_hdr = 0;
    for (const double sigma : {0.01, 0.03, 0.1, 0.2}) {
        const RgbImage noisy = with_noise(reference, sigma, 9);
        const double ldr = mean(ldr_flip(reference, noisy)), hdr = mean(hdr_flip(reference, noisy));
        EXPECT_GT(ldr, last_ldr) << sigma;
        EXPECT_GT(hdr, last_hdr) << sigma;
        last_ldr = ldr;
        last_hdr = hdr;
    }
}

TEST(HdrFlip, ExposuresPutTheBrightestAndTheMedianJustBelowWhite) {
    RgbImage reference = constant_image(10, 10, {0.5f, 0.5f, 0.5f});
    reference.pixels[0] = {64, 64, 64};
    const ExposureRange range = hdr_flip_exposures(reference);
    EXPECT_NEAR(range.stop - range.start, 7, 1e-5);
    EXPECT_EQ(range.count, 7);
    const auto aces = [](double x) { return (0.36 * 2.51 * x * x + 0.6 * 0.03 * x) / (0.36 * 2.43 * x * x + 0.6 * 0.59 * x + 0.14); };
    EXPECT_NEAR(aces(64 * std::exp2(range.start)), 0.85, 1e-5);
    EXPECT_NEAR(aces(0.5 * std::exp2(range.stop)), 0.85, 1e-5);
}

TEST(HdrFlip, DoesNotDependOnTheUnitOfLight) {
    const RgbImage a = random_image(24, 24, 5, 4), b = with_noise(a, 0.2, 6);
    RgbImage bright_a = a, bright_b = b;
    for (Vec3& p : bright_a.pixels) p = {p.x * 1024, p.y * 1024, p.z * 1024};
    for (Vec3& p : bright_b.pixels) p = {p.x * 1024, p.y * 1024, p.z * 1024};
    const std::vector<float> map = hdr_flip(a, b), bright = hdr_flip(bright_a, bright_b);
    for (size_t i = 0; i < map.size(); ++i) EXPECT_NEAR(map[i], bright[i], 1e-4);
}

TEST(HdrFlip, SeesDifferencesFarAboveWhite) {
    RgbImage reference = constant_image(32, 32, {0.2f, 0.2f, 0.2f});
    for (size_t i = 0; i < 64; ++i) reference.pixels[i] = {1000, 1000, 1000};
    RgbImage test = reference;
    for (size_t i = 0; i < 64; ++i) test.pixels[i] = {1000, 300, 1000};
    EXPECT_GT(hdr_flip(reference, test)[16], 0.1);
}

TEST(HdrFlip, BlackImagesAreHandled) {
    const RgbImage black = constant_image(8, 8, {0, 0, 0});
    RgbImage mostly_black = black;
    mostly_black.pixels[3] = {5, 5, 5};
    for (const float v : hdr_flip(black, black)) EXPECT_EQ(v, 0);
    EXPECT_EQ(hdr_flip_exposures(mostly_black).count, 2);
    EXPECT_TRUE(std::isfinite(mean(hdr_flip(mostly_black, black))));
    EXPECT_TRUE(std::isfinite(mean(hdr_flip(black, mostly_black))));
}

TEST(FlipNumbers, QuartilesAreWeighted) {
    // 90 pixels of nothing, 8 of 0.05, 1 of 0.25, 1 of 0.6: the sum is 1.25.
    std::vector<float> map(90, 0.f);
    map.insert(map.begin() + 40, 8, 0.05f);
    map.insert(map.begin() + 3, 0.6f);
    map.push_back(0.25f);
    const FlipNumbers n = flip_numbers(map);
    EXPECT_NEAR(n.mean, 0.0125, 1e-7);
    EXPECT_FLOAT_EQ(float(n.first_quartile), 0.05f);
    EXPECT_FLOAT_EQ(float(n.median), 0.25f) << "0.4 of 1.25 below, 0.65 of it up to this";
    EXPECT_FLOAT_EQ(float(n.third_quartile), 0.6f);
    EXPECT_FLOAT_EQ(float(n.largest), 0.6f);
    EXPECT_NEAR(n.share_noticeable, 0.02, 1e-12);
}

TEST(FlipNumbers, OfNoDifferenceAreZero) {
    for (const std::vector<float>& map : {std::vector<float>(), std::vector<float>(12, 0.f)}) {
        const FlipNumbers n = flip_numbers(map);
        for (const double value : {n.mean, n.first_quartile, n.median, n.third_quartile, n.largest, n.share_noticeable})
            EXPECT_EQ(value, 0);
    }
}

TEST(FlipNumbers, ConstantMapsHaveEqualQuartiles) {
    const FlipNumbers n = flip_numbers(std::vector<float>(1000, 0.3f));
    for (const double value : {n.mean, n.first_quartile, n.median, n.third_quartile, n.largest}) EXPECT_NEAR(value, 0.3, 1e-6);
    EXPECT_EQ(n.share_noticeable, 1);
}

} // namespace
} // namespace blush::TEST_FILE
