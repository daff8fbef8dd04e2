// Sampling warps have their stated density, and the weights of the power heuristic sum to 1.
#include "core/sampling.h"

#include "tests/support/statistics.h"

#include <random>

namespace blush::TEST_FILE {

using namespace statistics;

namespace {

struct Random {
    std::mt19937 bits{11};
    float operator()() { return float(bits() >> 8) * 0x1p-24f; }
};

constexpr int64_t samples = 400'000;

} // namespace

TEST(Sampling, DiskIsUniform) {
    Random u;
    constexpr int rings = 12, sectors = 24; // of equal area
    std::vector<int64_t> counts(rings * sectors);
    for (int64_t i = 0; i < samples; ++i) {
        const float a = u(), b = u();
        const Vec2 p = sample_disk(a, b);
        const double r2 = double(p.x) * p.x + double(p.y) * p.y, turn = std::atan2(p.y, p.x) / (2 * std::numbers::pi) + 0.5;
        ASSERT_LE(r2, 1 + 1e-6);
        ++counts[size_t(std::min(int(r2 * rings), rings - 1) * sectors + std::min(int(turn * sectors), sectors - 1))];
    }
    EXPECT_TRUE(chi_squared_test(counts, std::vector<double>(counts.size(), double(samples) / double(counts.size()))));
}

TEST(Sampling, CosineHemisphereFollowsItsDensity) {
    Random u;
    const auto draw = [&]() -> std::optional<Vec3> {
        const float a = u(), b = u();
        return sample_cosine_hemisphere(a, b);
    };
    EXPECT_TRUE(directions_follow({.samples = samples}, draw, [](const Vec3& w) { return cosine_hemisphere_pdf(w.z); }));
}

TEST(Sampling, CosineHemisphereIsNeverBelowTheHorizon) {
    for (const float u : {0.f, 0x1p-24f, 0.5f, one_minus_epsilon})
        for (const float v : {0.f, 0.25f, one_minus_epsilon}) {
            const Vec3 w = sample_cosine_hemisphere(u, v);
            EXPECT_GT(w.z, 0.f);
            EXPECT_NEAR(length(w), 1, 4 * 0x1p-23);
        }
}

// From the sun's disk (1.1e-5) and below to the whole sphere (2). Measured by the distance from the axis, which keeps its digits.
TEST(Sampling, ConeIsUniformInSolidAngleAtEveryHeight) {
    Random u;
    constexpr int rings = 12, sectors = 24;
    const std::vector<float> heights = {1e-8f, 1e-6f, 1.1e-5f, 1e-3f, 0.1f, 1.f, 2.f};
    for (const float height : heights) {
        std::vector<int64_t> counts(rings * sectors);
        for (int64_t i = 0; i < samples / 4; ++i) {
            const float a = u(), b = u();
            const Vec3 w = sample_cone(height, a, b);
            const double r2 = double(w.x) * w.x + double(w.y) * w.y;
            const double below = w.z > 0 ? r2 / (1 + std::sqrt(std::max(0.0, 1 - r2))) : 1.0 - w.z;
            const double turn = std::atan2(w.y, w.x) / (2 * std::numbers::pi) + 0.5;
            ASSERT_LE(below, height * (1 + 1e-5) + 1e-7 * (height > 0.5f));
            ASSERT_NEAR(length(w), 1, 4 * 0x1p-23);
            ++counts[size_t(std::min(int(below / height * rings), rings - 1) * sectors + std::min(int(turn * sectors), sectors - 1))];
        }
        const std::vector<double> expected(counts.size(), double(samples / 4) / double(counts.size()));
        EXPECT_TRUE(chi_squared_test(counts, expected, sidak(significance, int64_t(heights.size())))) << "height " << height;
    }
}

TEST(Sampling, TriangleIsUniform) {
    Random u;
    constexpr int n = 16; // n^2 congruent pieces: of each square below the diagonal a lower and an upper half
    std::vector<int64_t> counts(2 * n * n);
    std::vector<double> expected(counts.size());
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n - i; ++j)
            for (int half = 0; half < (j == n - 1 - i ? 1 : 2); ++half)
                expected[size_t((i * n + j) * 2 + half)] = double(samples) / (n * n);
    for (int64_t k = 0; k < samples; ++k) {
        const float a = u(), b = u();
        const Vec2 p = sample_triangle(a, b);
        ASSERT_TRUE(p.x >= 0 && p.y >= 0 && p.x + p.y <= 1);
        const int i = std::min(int(p.x * n), n - 1), j = std::min(int(p.y * n), n - 1 - i);
        const bool upper = double(p.x) * n - i + double(p.y) * n - j > 1 && j < n - 1 - i;
        ++counts[size_t((i * n + j) * 2 + upper)];
    }
    EXPECT_TRUE(chi_squared_test(counts, expected));
}

TEST(Sampling, PowerHeuristicWeightsSumToOne) {
    const std::vector<float> densities = {1e-38f, 1e-20f, 1e-3f, 0.3f, 1.f, 7.f, 1e5f, 1e20f, 3e38f};
    for (const float a : densities) {
        EXPECT_EQ(power_heuristic(a, 0.f), 1.f);
        EXPECT_EQ(power_heuristic(a, infinity), 0.f);
        for (const float b : densities) {
            EXPECT_NEAR(power_heuristic(a, b) + power_heuristic(b, a), 1, 2 * 0x1p-23) << a << ", " << b;
            const double exact = 1 / (1 + std::pow(double(b) / double(a), 2));
            EXPECT_NEAR(power_heuristic(a, b), exact, 4e-7 * exact + 1e-38) << a << ", " << b;
        }
    }
}

} // namespace blush::TEST_FILE
