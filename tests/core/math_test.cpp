// Elementary functions: error bounds against double precision, and equal results for all lanes.
#include "core/math.h"
#include "core/sampling.h"

#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <vector>

namespace blush::TEST_FILE {

namespace {

constexpr int steps = 1 << 20;
constexpr double ulp_of_1 = 0x1p-23;

// x_i evenly over [low, high].
float at(int i, double low, double high) { return float(low + (high - low) * i / (steps - 1)); }

// Checks that fn(x...) of a register is bit-identical to fn of each lane. Random arguments in [low, high].
template <int arity, class Fn> void expect_same_in_lanes(float low, float high, Fn fn) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(low, high);
    for (int round = 0; round < 10'000; ++round) {
        float x[3][64] = {};
        for (auto& row : x)
            for (float& value : row) value = uniform(random);
        const std::vector<Wide> wide = fn(load<Wide>(x[0]), load<Wide>(x[1]), load<Wide>(x[2]));
        for (int i = 0; i < width<Wide>; ++i) {
            const std::vector<float> one = fn(x[0][i], x[1][i], x[2][i]);
            ASSERT_EQ(one.size(), wide.size());
            for (size_t k = 0; k < one.size(); ++k)
                ASSERT_EQ(float_bits(one[k]), float_bits(lane(wide[k], i)))
                    << "output " << k << " of " << x[0][i] << ", " << x[1][i] << ", " << x[2][i];
        }
    }
}

} // namespace

TEST(Math, SinCosOfTurnsWithinTheirError) {
    for (int i = 0; i < steps; ++i) {
        const float u = at(i, -4, 4);
        const SinCos<float> a = sincos_turns(u);
        const double angle = 2 * std::numbers::pi * double(u);
        ASSERT_NEAR(a.sin, std::sin(angle), 1e-7) << u;
        ASSERT_NEAR(a.cos, std::cos(angle), 1e-7) << u;
    }
}

TEST(Math, ExpWithinItsRelativeError) {
    for (int i = 0; i < steps; ++i) {
        const float x = at(i, -87, 88);
        const double exact = std::exp(double(x));
        ASSERT_NEAR(blush::exp(x), exact, 2e-7 * exact) << x;
    }
    EXPECT_EQ(blush::exp(0.f), 1.f);
    EXPECT_EQ(blush::exp(-88.f), 0.f);
    EXPECT_EQ(blush::exp(-infinity), 0.f);
    EXPECT_EQ(blush::exp(1e30f), blush::exp(88.f));
}

TEST(Math, ArcTangentWithinItsErrorInEveryDirection) {
    for (int i = 0; i < steps; ++i) {
        const double angle = at(i, -std::numbers::pi, std::numbers::pi);
        const float y = float(3 * std::sin(angle)), x = float(3 * std::cos(angle));
        ASSERT_NEAR(atan2_turns(y, x), std::atan2(double(y), double(x)) / (2 * std::numbers::pi), 1.4e-7) << y << ", " << x;
    }
    EXPECT_EQ(atan2_turns(0.f, 0.f), 0.f);
    EXPECT_EQ(atan2_turns(0.f, 1.f), 0.f);
    EXPECT_EQ(atan2_turns(1.f, 0.f), 0.25f);
    EXPECT_EQ(atan2_turns(-1.f, 0.f), -0.25f);
    EXPECT_EQ(atan2_turns(0.f, -1.f), 0.5f);
}

TEST(Math, BasisIsOrthonormalAndRightHandedEverywhere) {
    std::mt19937 random(2);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 100'000; ++i) {
        Vec3 n{normal(random), normal(random), normal(random)};
        if (i % 3 == 0) n = {n.x * 1e-4f, n.y * 1e-4f, i % 2 ? 1.f : -1.f}; // near the poles
        n = normalize(n);
        const Basis<float> b = basis_around(n);
        const Vec3 right = cross(b.s, b.t) - n;
        ASSERT_NEAR(dot(b.s, b.t), 0, 4 * ulp_of_1);
        ASSERT_NEAR(dot(b.s, n), 0, 4 * ulp_of_1);
        ASSERT_NEAR(dot(b.t, n), 0, 4 * ulp_of_1);
        ASSERT_NEAR(length(b.s), 1, 4 * ulp_of_1);
        ASSERT_NEAR(length(b.t), 1, 4 * ulp_of_1);
        ASSERT_LT(length(right), 8 * ulp_of_1);
        const Vec3 w{0.6f, -0.48f, 0.64f};
        ASSERT_LT(length(b.to_local(b.to_world(w)) - w), 8 * ulp_of_1);
    }
    for (const Vec3 pole : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{0, 0, -0.f}}) EXPECT_TRUE(is_finite(basis_around(pole).s));
}

TEST(Math, InverseUndoesAnAffineMap) {
    const Affine m{{2, 0.5f, 0}, {-1, 1, 0.25f}, {0, 3, -2}, {5, -7, 11}};
    const Vec3 p{0.3f, -4, 2};
    EXPECT_LT(length(transform_point(inverse(m), transform_point(m, p)) - p), 32 * ulp_of_1);
    // A cofactor matrix maps normals: it keeps them orthogonal to mapped tangents.
    const Vec3 n{0.6f, 0, 0.8f}, tangent{-0.8f, 0, 0.6f};
    EXPECT_NEAR(dot(transform_vector(cofactor(m), n), transform_vector(m, tangent)), 0, 64 * ulp_of_1);
}

TEST(Math, LanesEqualOnePathBitForBit) {
    expect_same_in_lanes<1>(-4, 4, [](auto x, auto, auto) { return std::vector{sincos_turns(x).sin, sincos_turns(x).cos}; });
    expect_same_in_lanes<1>(-90, 90, [](auto x, auto, auto) {
        return std::vector{blush::exp(x), blush::floor(x), blush::abs(x), pow5(x)};
    });
    expect_same_in_lanes<2>(-1, 1, [](auto x, auto y, auto) { return std::vector{atan2_turns(x, y), min(x, y), max(x, y), x / y}; });
    expect_same_in_lanes<3>(-1, 1, [](auto x, auto y, auto z) {
        const Vec n = normalize(Vec<decltype(x)>{x, y, z});
        const auto b = basis_around(n);
        return std::vector{n.x, n.y, n.z, b.s.x, b.s.y, b.s.z, b.t.x, b.t.y, b.t.z, luminance(n), max_component(n)};
    });
    expect_same_in_lanes<3>(0, 1, [](auto x, auto y, auto z) {
        const auto disk = sample_disk(x, y);
        const auto cosine = sample_cosine_hemisphere(x, y);
        const auto cone = sample_cone(z, x, y);
        const auto triangle = sample_triangle(x, y);
        return std::vector{
            disk.x, disk.y, cosine.x, cosine.y, cosine.z, cone.x, cone.y, cone.z, triangle.x, triangle.y, power_heuristic(x, y)};
    });
}

TEST(Math, MinAndMaxTakeTheSecondOfNaNInEveryLane) {
    const float nan = NAN;
    EXPECT_EQ(min(nan, 2.f), 2.f);
    EXPECT_EQ(max(nan, 2.f), 2.f);
    for (int i = 0; i < width<Wide>; ++i) {
        EXPECT_EQ(lane(min(Wide(nan), Wide(2.f)), i), 2.f);
        EXPECT_EQ(lane(max(Wide(nan), Wide(2.f)), i), 2.f);
    }
}

} // namespace blush::TEST_FILE
