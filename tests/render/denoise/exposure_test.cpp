#include "render/denoise/exposure.h"

#include "tests/render/denoise/agreement.h"

#include <cmath>
#include <limits>

namespace blush::test::TEST_FILE {
namespace {

using namespace denoise;

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();

float scale_of(const Planes& planes) { return exposure_scale_of({planes.color, 3}, planes.width, planes.height, Workers(2)); }

TEST(Exposure, BringsTheMeanToMiddleGrey) {
    for (const float value : {1e-6f, 0.18f, 1.f, 1e9f}) EXPECT_NEAR(scale_of(constant_planes(37, 21, value)) * value, 0.18, 1e-6);
    // Half of the blocks have 1/4, half 4: the geometric mean is 1.
    Planes halves = constant_planes(64, 16, 0.25f);
    for (int y = 0; y < 16; y++) std::fill_n(&halves.color[(size_t(y) * 64 + 32) * 3], 32 * 3, 4.f);
    EXPECT_NEAR(scale_of(halves), 0.18, 1e-6);
}

TEST(Exposure, BlackIsExcluded) {
    EXPECT_EQ(scale_of(constant_planes(1, 1, 0)), 1);
    EXPECT_EQ(scale_of(constant_planes(40, 40, -1)), 1);
    EXPECT_EQ(scale_of(constant_planes(40, 40, nan)), 1);
    Planes half = constant_planes(64, 16, 0);
    for (int y = 0; y < 16; y++) std::fill_n(&half.color[size_t(y) * 64 * 3], 32 * 3, 0.5f);
    EXPECT_NEAR(scale_of(half), 0.36, 1e-6);
}

TEST(Exposure, StaysWithinTheRangeOfFloat) {
    for (const float value : {1e-7f, 1e30f, std::numeric_limits<float>::max()}) {
        const float scale = scale_of(constant_planes(20, 20, value));
        EXPECT_GE(scale, min_scale_factor);
        EXPECT_LE(scale, max_scale);
    }
    Planes odd = constant_planes(64, 64, 0.18f);
    odd.color[0] = nan;
    odd.color[100] = infinite;
    odd.color[200] = -infinite;
    EXPECT_NEAR(scale_of(odd), 1, 0.01);
}

TEST(Inspection, CountsInvalidPixelsAndKeepsTheMeanFinite) {
    Planes planes = constant_planes(10, 10, 1);
    planes.color[0] = planes.color[1] = nan; // two components of one pixel
    planes.color[30] = -0.5f;
    planes.color[60] = infinite;
    planes.color[90] = 3;
    const Inspection found = inspect({planes.color, 3}, 10, 10, 2, Workers(2));
    EXPECT_EQ(found.unusual, 4);
    const double red = 0.212671, green = 0.715160;
    EXPECT_NEAR(found.mean_luminance, 1 + 0.01 * (-red - green - 1.5 * red - red + 2 * red), 1e-6);
}

} // namespace
} // namespace blush::test::TEST_FILE
