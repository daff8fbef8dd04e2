// Interpolation of keyframes against closed forms.
#include "scene/animation/keyframes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace blush::TEST_FILE {
namespace {

using Interpolation = Keyframes::Interpolation;
constexpr double pi_ = std::numbers::pi;

Quat about_z(double degrees) {
    const double half = degrees * pi_ / 360;
    return {0, 0, float(std::sin(half)), float(std::cos(half))};
}
// The angle between two rotations in degrees.
double between(const Quat& a, const Quat& b) {
    // By the chord, which is more accurate for small angles than the cosine. Both signs of a quaternion are one rotation.
    const auto chord = [&](double sign) {
        return std::hypot(std::hypot(a.x - sign * b.x, a.y - sign * b.y), std::hypot(a.z - sign * b.z, a.w - sign * b.w));
    };
    return 4 * std::asin(std::min(chord(1), chord(-1)) / 2) * 180 / pi_;
}
Keyframes turning(const Quat& a, const Quat& b) { return {Interpolation::linear, {0, 1}, {a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w}}; }

TEST(Keyframes, LinearIsTheStraightLineAndHoldsAtItsEnds) {
    const Keyframes k{Interpolation::linear, {1, 3, 4}, {0, 0, 0, 4, -2, 8, 4, 0, 0}};
    EXPECT_EQ(width_of(k), 3u);
    EXPECT_EQ(value_at(k, 0), (std::vector<float>{0, 0, 0}));
    EXPECT_EQ(value_at(k, 1), (std::vector<float>{0, 0, 0}));
    EXPECT_EQ(value_at(k, 1.5f), (std::vector<float>{1, -0.5f, 2}));
    EXPECT_EQ(value_at(k, 3), (std::vector<float>{4, -2, 8}));
    EXPECT_EQ(value_at(k, 3.5f), (std::vector<float>{4, -1, 4}));
    EXPECT_EQ(value_at(k, 4), (std::vector<float>{4, 0, 0}));
    EXPECT_EQ(value_at(k, 1e30f), (std::vector<float>{4, 0, 0}));
}

TEST(Keyframes, StepHoldsUntilTheNext) {
    const Keyframes k{Interpolation::step, {0, 1, 2}, {5, 6, 7}};
    EXPECT_EQ(value_at(k, 0.999f), std::vector<float>{5});
    EXPECT_EQ(value_at(k, 1), std::vector<float>{6});
    EXPECT_EQ(value_at(k, 2), std::vector<float>{7});
}

// A cubic Hermite spline with the derivatives of a cubic as tangents is that cubic: t^3 between 1 and 3.
TEST(Keyframes, ASplineWithTheTangentsOfACubicIsTheCubic) {
    const Keyframes k{Interpolation::cubic_spline, {1, 3}, {99, 1, 3, 27, 27, -99}};
    EXPECT_EQ(width_of(k), 1u);
    for (const float t : {1.f, 1.25f, 1.5f, 2.f, 2.75f, 3.f}) EXPECT_FLOAT_EQ(value_at(k, t)[0], t * t * t) << t;
    EXPECT_EQ(value_at(k, 0)[0], 1);
    EXPECT_EQ(value_at(k, 9)[0], 27);
}

TEST(Keyframes, SphericalInterpolationTurnsAtConstantSpeed) {
    const Keyframes k = turning(about_z(10), about_z(100));
    for (const float t : {0.f, 0.25f, 0.5f, 0.9f, 1.f}) EXPECT_NEAR(between(rotation_at(k, t), about_z(10 + 90 * double(t))), 0, 1e-3) << t;
}

TEST(Keyframes, RotationsTakeTheShorterArc) {
    Quat far = about_z(90);
    far = {-far.x, -far.y, -far.z, -far.w}; // the same rotation
    EXPECT_NEAR(between(rotation_at(turning({}, far), 0.5f), about_z(45)), 0, 1e-3);
    EXPECT_NEAR(between(rotation_at(turning(about_z(170), about_z(-170)), 0.5f), about_z(180)), 0, 1e-3);
}

TEST(Keyframes, RotationsAreUnitQuaternionsWhateverTheKeysAre) {
    for (const Keyframes& k :
         {turning({}, {}), turning({}, {0, 0, 0, -1}), turning({0, 0, 0, 0}, {0, 0, 0, 0}), turning({1, 2, 3, 4}, {-4, 3, 2, 1}),
          Keyframes{Interpolation::cubic_spline, {0, 1}, {0, 0, 0, 0, 0, 0, 0, 1, 3, 0, 0, 0, 0, 0, 3, 0, 1, 0, 0, 0, 0, 0, 0, 0}}})
        for (const float t : {0.f, 0.3f, 0.5f, 1.f}) {
            const Quat q = rotation_at(k, t);
            EXPECT_NEAR(double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z + double(q.w) * q.w, 1, 1e-6) << t;
        }
}

TEST(Keyframes, OfEqualTimesTheLastCounts) {
    const Keyframes k{Interpolation::linear, {0, 1, 1, 2}, {0, 10, 20, 30}};
    EXPECT_EQ(value_at(k, 1)[0], 20);
    EXPECT_EQ(value_at(k, 0.5f)[0], 5);
    EXPECT_EQ(value_at(k, 1.5f)[0], 25);
}

} // namespace
} // namespace blush::TEST_FILE
