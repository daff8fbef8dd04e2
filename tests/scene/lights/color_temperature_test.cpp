#include "scene/lights/color_temperature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace blush::TEST_FILE {
namespace {

struct Chromaticity {
    double x, y;
};

Chromaticity chromaticity(const Vec3& rgb) {
    const double x = 0.4123908 * rgb.x + 0.3575843 * rgb.y + 0.1804808 * rgb.z;
    const double y = 0.2126390 * rgb.x + 0.7151687 * rgb.y + 0.0721923 * rgb.z;
    const double z = 0.0193308 * rgb.x + 0.1191948 * rgb.y + 0.9505322 * rgb.z;
    return {x / (x + y + z), y / (x + y + z)};
}

// CIE 1931 chromaticities of the Planckian locus (Wyszecki and Stiles, Color Science, table 1(3.11)); 2856 K is CIE illuminant A. The
// colour matching fit used is good to a few thousandths.
TEST(BlackBody, LiesOnThePlanckianLocus) {
    const struct {
        float kelvin;
        double x, y;
    } locus[] = {{2856, 0.4476, 0.4074}, {4000, 0.3805, 0.3768}, {5000, 0.3451, 0.3516}, {6500, 0.3135, 0.3237}, {10000, 0.2807, 0.2884}};
    for (const auto& [kelvin, x, y] : locus) {
        const Chromaticity c = chromaticity(black_body_color(kelvin));
        EXPECT_NEAR(c.x, x, 0.004) << kelvin;
        EXPECT_NEAR(c.y, y, 0.004) << kelvin;
    }
}

TEST(BlackBody, HasLuminanceOneAndNoNegativeParts) {
    for (float kelvin = min_kelvin; kelvin <= max_kelvin; kelvin *= 1.1f) {
        const Vec3 c = black_body_color(kelvin);
        EXPECT_NEAR(0.2126729 * c.x + 0.7151522 * c.y + 0.0721750 * c.z, 1, 1e-5) << kelvin;
        EXPECT_GE(c.x, 0) << kelvin;
        EXPECT_GE(c.y, 0) << kelvin;
        EXPECT_GE(c.z, 0) << kelvin;
    }
}

TEST(BlackBody, GoesFromRedToBlue) {
    double last = 1e9;
    for (float kelvin = min_kelvin; kelvin <= max_kelvin; kelvin *= 1.1f) {
        const Vec3 c = black_body_color(kelvin);
        const double redness = double(c.x) / (double(c.z) + 1e-3);
        EXPECT_LT(redness, last) << kelvin;
        last = redness;
    }
}

// The result is off the locus by the requested tint, perpendicular to it; a positive tint is towards green.
TEST(BlackBody, GreenTintIsPerpendicularToTheLocus) {
    const auto uv = [](const Vec3& c) {
        const Chromaticity xy = chromaticity(c);
        const double d = -2 * xy.x + 12 * xy.y + 3;
        return std::pair{4 * xy.x / d, 6 * xy.y / d};
    };
    for (const float kelvin : {4000.f, 6500.f, 9000.f}) // Rec.709 has all of these
        for (const float tint : {-0.01f, 0.005f, 0.01f}) {
            const auto [u0, v0] = uv(black_body_color(kelvin));
            const auto [u1, v1] = uv(black_body_color(kelvin * 1.01f));
            const auto [u, v] = uv(black_body_color(kelvin, tint));
            EXPECT_NEAR(std::hypot(u - u0, v - v0), std::abs(tint), 2e-4) << kelvin;
            EXPECT_NEAR(((u - u0) * (u1 - u0) + (v - v0) * (v1 - v0)) / (std::hypot(u1 - u0, v1 - v0) * double(std::abs(tint))), 0, 0.03)
                << kelvin;
            EXPECT_GT((v - v0) * double(tint), 0) << "above the locus is green";
        }
}

TEST(BlackBody, ClampsOutOfRangeTemperatures) {
    EXPECT_EQ(black_body_color(0), black_body_color(min_kelvin));
    EXPECT_EQ(black_body_color(1e9f), black_body_color(max_kelvin));
}

TEST(TemperatureOf, InvertsBlackBodyColor) {
    for (const float kelvin : {2000.f, 2856.f, 4000.f, 6504.f, 12000.f, 25000.f})
        for (const float tint : {-0.01f, 0.f, 0.01f}) {
            const Vec3 color = black_body_color(kelvin, tint);
            if (color.x <= 0 || color.y <= 0 || color.z <= 0) continue; // beyond Rec.709: not the colour itself
            const ColorTemperature found = temperature_of(color);
            EXPECT_NEAR(found.kelvin / kelvin, 1, 0.01) << kelvin << ' ' << tint;
            EXPECT_NEAR(found.green_tint, tint, 2e-4) << kelvin << ' ' << tint;
        }
    const ColorTemperature white = temperature_of({1, 1, 1}); // D65: 6504 K, Duv 0.0032
    EXPECT_NEAR(white.kelvin, 6504, 15);
    EXPECT_NEAR(white.green_tint, 0.0032, 2e-4);
    EXPECT_EQ(temperature_of({0, 0, 0}).kelvin, ColorTemperature{}.kelvin);
}

} // namespace
} // namespace blush::TEST_FILE
