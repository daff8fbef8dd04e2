// Error of an image against a noisy reference: unbiased, and the interval covers the true value.
#include "measure/metrics/image_error.h"
#include "measure/metrics/metrics.h"
#include "tests/support/statistics.h"

#include <limits>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr size_t pixels = 1500;

struct Noise {
    std::mt19937 bits;
    std::normal_distribution<double> normal;
    double operator()(double sigma) { return sigma * normal(bits); }
};

double truth(size_t i) { return 0.2 + double(i % 7) * 0.3; }

// An image with a known error pattern: a denoised image is blurred, not noisy.
std::vector<float> blurred() {
    std::vector<float> rgb;
    for (size_t i = 0; i < pixels; ++i)
        for (int k = 0; k < 3; ++k) rgb.push_back(float(truth(i) + 0.03 * std::sin(double(i) * 0.7)));
    return rgb;
}

double true_rmse(const std::vector<float>& rgb) {
    double sum = 0;
    for (size_t i = 0; i < rgb.size(); ++i) sum += std::pow(double(rgb[i]) - truth(i / 3), 2);
    return std::sqrt(sum / double(rgb.size()));
}

// The mean of two halves, each off by sigma sqrt(2).
MeasuredImage noisy_reference(Noise& noise, double sigma) {
    MeasuredImage m;
    m.image = {int(pixels), 1, std::vector<Vec3>(pixels)};
    m.error.resize(pixels);
    for (size_t i = 0; i < pixels; ++i)
        for (float Vec3::*channel : {&Vec3::x, &Vec3::y, &Vec3::z}) {
            const double a = truth(i) + noise(sigma * std::sqrt(2)), b = truth(i) + noise(sigma * std::sqrt(2));
            m.image.pixels[i].*channel = float((a + b) / 2);
            m.error[i].*channel = float(std::abs(a - b) / 2);
        }
    return m;
}

TEST(ImageError, IsUnbiasedForANoisyReference) {
    Noise noise{std::mt19937(5), {}};
    const std::vector<float> image = blurred();
    const double rmse = true_rmse(image);
    Moments squares, missed;
    for (int run = 0; run < 400; ++run) {
        const ImageError e = error_against({image, 3}, noisy_reference(noise, 2 * rmse));
        squares.add(e.rmse.value * e.rmse.value);
        missed.add(e.rmse.low > rmse || rmse > e.rmse.high);
        EXPECT_TRUE(e.rmse.known);
    }
    EXPECT_TRUE(z_test(squares, rmse * rmse, sidak(significance, 2)));
    EXPECT_TRUE(z_test_at_most(missed, 0.05, sidak(significance, 2)));
}

TEST(ImageError, IsUnknownForAMuchWorseReference) {
    Noise noise{std::mt19937(6), {}};
    const std::vector<float> image = blurred();
    int known = 0;
    for (int run = 0; run < 50; ++run) known += error_against({image, 3}, noisy_reference(noise, 60 * true_rmse(image))).rmse.known;
    EXPECT_LT(known, 10);
}

TEST(ImageError, AgainstAPerfectReferenceIsTheMetric) {
    Noise noise{std::mt19937(7), {}};
    const MeasuredImage perfect = noisy_reference(noise, 0);
    const ImageError e = error_against({blurred(), 3}, perfect);
    EXPECT_NEAR(e.rmse.value, true_rmse(blurred()), 1e-6);
    RgbImage image{int(pixels), 1, {}};
    const std::vector<float> rgb = blurred();
    for (size_t i = 0; i < pixels; ++i) image.pixels.push_back({rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]});
    EXPECT_NEAR(e.relmse.value, compare(image, perfect.image, Encoding::scene_linear, false)->relmse, 1e-6);
}

// A later image shares samples with the measured one: the interval covers the true value for any correlation.
TEST(ImageError, IntervalCoversForSharedSamples) {
    Noise noise{std::mt19937(8), {}};
    for (const double shared : {-1.0, 0.0, 1.0}) {
        std::vector<float> image, raw;
        double squares = 0;
        constexpr double own = 0.1, later = 0.03;
        for (size_t i = 0; i < pixels; ++i) {
            for (int k = 0; k < 3; ++k) {
                const double n = noise(1), r = later * (shared * n + std::sqrt(1 - shared * shared) * noise(1));
                image.push_back(float(truth(i) + own * n));
                raw.push_back(float(truth(i) + r));
                squares += r * r;
            }
            raw.push_back(1);
        }
        const double raw_rmse = std::sqrt(squares / (3 * double(pixels)));
        const ErrorEstimate known{false, 0, 0, 0, true, raw_rmse, raw_rmse, raw_rmse * (1 + 1e-6)};
        const ImageError e = error_against({image, 3}, {raw, 4}, known);
        EXPECT_TRUE(e.rmse.known);
        EXPECT_FALSE(e.relmse.known) << "nor is that of the raw image";
        EXPECT_LE(e.rmse.low, true_rmse(image)) << shared;
        EXPECT_GE(e.rmse.high, true_rmse(image)) << shared;
        const ErrorEstimate poor{false, 0, 0, 0, true, 0.06, 0.05, 0.07};
        EXPECT_FALSE(error_against({image, 3}, {raw, 4}, poor).rmse.known) << "no better than the measured image";
    }
}

TEST(ImageError, LeavesOutWhatIsNotFinite) {
    const float inf = std::numeric_limits<float>::infinity();
    MeasuredImage m;
    m.image = {3, 1, {{1, 1, 1}, {1, 1, 1}, {inf, 1, 1}}};
    m.error.resize(3);
    EXPECT_EQ(error_against({std::vector<float>{2, 2, 2, inf, 1, 1, 1, 1, 1}, 3}, m).rmse.value, 0) << "a single pixel is not enough";
    m.image.pixels[2] = {1, 1, 1};
    EXPECT_NEAR(error_against({std::vector<float>{2, 2, 2, inf, 1, 1, 2, 2, 2}, 3}, m).rmse.value, 1, 1e-9);
    EXPECT_FALSE(error_against({{}, 3}, m).rmse.known);
}

} // namespace
} // namespace blush::test::TEST_FILE
