#include "render/denoise/transfer.h"

#include "render/denoise/band_ops.h"
#include "render/denoise/pixels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace denoise;

// The published curve in double precision.
double curve(double y) {
    if (y <= 1.5794576e-6) return 1412.83765 * y;
    if (y <= 0.0322087631) return 1.64593172 * std::pow(y, 0.431384981) - 0.00294139609;
    return 0.192653254 * std::log(y + 0.00626026094) + 0.998620152;
}

// From 1e-9 to the largest radiance, eight values an octave and the breaks.
std::vector<float> radiances() {
    std::vector<float> values{0, 1.5794576e-6f, 0.0322087631f, max_network_radiance};
    for (float y = 1e-9f; y < max_network_radiance; y *= 1.0905077f) values.push_back(y);
    return values;
}

TEST(Transfer, LogarithmMatchesTheLibrary) {
    for (float x = 1e-30f; x < 1e30f; x *= 1.01f)
        EXPECT_NEAR(denoise::log(x), std::log(double(x)), 2e-7 * std::max(1.0, std::abs(std::log(double(x))))) << x;
}

TEST(Transfer, IsThePublishedCurve) {
    // Relative errors of exp and log are below 2e-7 each, plus the rounding of about five operations on numbers of size 1.
    for (const float y : radiances()) EXPECT_NEAR(encode_radiance(y), curve(y), 1e-6 * std::max(curve(y), 3e-3)) << y;
}

TEST(Transfer, InverseRoundTrips) {
    // The inverse magnifies errors of x near 1 by dy / y = dx x / 0.19.
    for (const float y : radiances()) EXPECT_NEAR(decode_radiance(encode_radiance(y)), y, 3e-5 * std::max(y, 1e-6f)) << y;
}

TEST(Transfer, RegistersAndScalarsAreBitIdentical) {
    const std::vector<float> values = radiances();
    for (const float y : values) {
        EXPECT_EQ(lane(encode_radiance(Wide(y)), 0), encode_radiance(y)) << y;
        EXPECT_EQ(lane(decode_radiance(Wide(encode_radiance(y))), 0), decode_radiance(encode_radiance(y))) << y;
    }
}

TEST(Pixels, ColorRoundTrip) {
    std::vector<float> rgba, back(3);
    for (const float y : radiances()) rgba.insert(rgba.end(), {y / 4, y / 8, y / 16, 1});
    const int count = int(rgba.size() / 4);
    std::vector<float> network(size_t(count) * 9, 7), rgb(size_t(count) * 3), packed;
    encode_color(rgba.data(), 4, count, 2.f, network.data(), 9);
    for (int i = 0; i < count; i++) {
        for (int c = 3; c < 9; c++) EXPECT_EQ(network[9 * i + c], 7) << "other channels are unchanged";
        packed.insert(packed.end(), &network[9 * i], &network[9 * i] + 3);
    }
    decode_color(packed.data(), count, 2.f, rgb.data());
    for (int i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) EXPECT_NEAR(rgb[3 * i + c], rgba[4 * i + c], 3e-5 * std::max(rgba[4 * i + c], 1e-6f));
}

TEST(Pixels, NetworkInputIsInRange) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    const std::vector<float> odd{nan, -1, infinite, -infinite, 1e30f, 0.5f};
    std::vector<float> seen(6);
    encode_color(odd.data(), 3, 2, 1, seen.data(), 3);
    EXPECT_EQ(seen, (std::vector<float>{0, 0, 1, 0, 1, encode_radiance(0.5f) * (1.f / encode_radiance(max_network_radiance))}));
    encode_albedo(odd.data(), 3, 2, seen.data(), 3);
    EXPECT_EQ(seen, (std::vector<float>{0, 0, 1, 0, 1, 0.5f}));
    encode_normal(odd.data(), 3, 2, seen.data(), 3);
    EXPECT_EQ(seen, (std::vector<float>{0.5f, 0, 1, 0, 1, 0.75f}));
    for (const float scale : {1e-30f, 1.f, 1e30f}) {
        decode_color(odd.data(), 2, scale, seen.data());
        for (const float x : seen) EXPECT_TRUE(std::isfinite(x) && x >= 0) << x << " at " << scale;
    }
}

TEST(Bfloat16, RoundsToNearestEven) {
    EXPECT_EQ(to_bfloat16(1), 0x3f80);
    EXPECT_EQ(to_bfloat16(1 + 0x1p-8f), 0x3f80);
    EXPECT_EQ(to_bfloat16(1 + 3 * 0x1p-8f), 0x3f82);
    EXPECT_EQ(to_bfloat16(1 + 0x1.01p-8f), 0x3f81);
    EXPECT_EQ(to_bfloat16(0), 0);
    EXPECT_EQ(to_bfloat16(3.0e38f), 0x7f62);
}

TEST(Bfloat16, TwoPartsHoldSixteenBits) {
    const std::vector<float> from{0.3f, 0.7001f, 0.25f, 1, 0.1f, 0};
    std::vector<Bfloat16> to(10);
    split_row(from.data(), 3, 2, to.data(), 2);
    for (int x = 0; x < 2; x++) {
        for (int c = 0; c < 2; c++)
            EXPECT_NEAR(denoise::to_float(to[5 * x + c]) + denoise::to_float(to[5 * x + 3 + c]), from[3 * x + c],
                        0x1p-17 * from[3 * x + c]);
        EXPECT_EQ(to[5 * x + 2], to_bfloat16(from[3 * x + 2]));
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
