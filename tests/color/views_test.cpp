// Views of the shipped config: known values, required curve properties, and non-finite input.
#include "tests/color/shipped_config.h"

#include <cmath>
#include <limits>
#include <vector>

namespace blush::TEST_FILE {
namespace {

const std::vector<std::string> all_displays{"sRGB", "Rec.1886", "Display P3"};
const std::vector<std::string> all_views{"ACES SDR", "Standard", "Raw"};

void expect_near(const Pixel& got, const Pixel& wanted, double tolerance = invisible) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[size_t(i)], wanted[size_t(i)], tolerance) << "channel " << i;
}

TEST(ColorViews, StandardOnSrgbIsTheSrgbCurve) {
    const auto color = shipped_config();
    EXPECT_NEAR(show(color, "sRGB", "Standard", grey(0.18f))[0], 0.4614, 0.00005); // the textbook number, four digits
    for (const float x : {0.0f, 0.001f, 0.0031308f, 0.02f, 0.18f, 0.5f, 0.735f, 1.0f})
        expect_near(show(color, "sRGB", "Standard", grey(x)), grey(float(srgb_encoded(x))));
    const Pixel mixed{0.8f, 0.3f, 0.05f};
    expect_near(show(color, "sRGB", "Standard", mixed),
                {float(srgb_encoded(mixed[0])), float(srgb_encoded(mixed[1])), float(srgb_encoded(mixed[2]))});
}

TEST(ColorViews, StandardOnRec1886IsGamma24) {
    const auto color = shipped_config();
    for (const float x : {0.0f, 0.01f, 0.18f, 0.5f, 1.0f})
        expect_near(show(color, "Rec.1886", "Standard", grey(x)), grey(std::pow(x, 1 / 2.4f)));
}

TEST(ColorViews, DisplayP3ShowsTheSameRedWithSmallerNumbers) {
    const auto color = shipped_config();
    expect_near(show(color, "sRGB", "Standard", {1, 0, 0}), {1, 0, 0});
    // The red of Rec.709 in Display P3 as CSS Color 4 gives it, to its five digits.
    expect_near(show(color, "Display P3", "Standard", {1, 0, 0}), {0.91749f, 0.20029f, 0.13856f}, 0.000005 + invisible);
    // White and greys are the same in both: same white point, same curve.
    for (const float x : {0.05f, 0.18f, 1.0f})
        expect_near(show(color, "Display P3", "Standard", grey(x)), show(color, "sRGB", "Standard", grey(x)));
    // A red outside Rec.709 clips on sRGB and still moves on Display P3.
    const Pixel wide{1.1f, -0.02f, 0}, wider{1.2f, -0.04f, 0};
    EXPECT_EQ(show(color, "sRGB", "Standard", wide), show(color, "sRGB", "Standard", wider));
    EXPECT_LT(show(color, "Display P3", "Standard", wide)[0], show(color, "Display P3", "Standard", wider)[0]);
}

TEST(ColorViews, RawChangesNothing) {
    const auto color = shipped_config();
    for (const auto& display : all_displays) EXPECT_EQ(show(color, display, "Raw", {0.1f, 0.5f, 0.9f}), (Pixel{0.1f, 0.5f, 0.9f}));
}

TEST(ColorViews, AcesRisesFromBlackToWhiteAndKeepsGreysGrey) {
    const auto color = shipped_config();
    for (const auto& display : all_displays) {
        float before = -1;
        for (float ev = -12; ev <= 12; ev += 0.25f) {
            const Pixel p = show(color, display, "ACES SDR", grey(0.18f * std::exp2(ev)));
            EXPECT_GE(p[0], before) << display << " at " << ev << " EV";
            EXPECT_GE(p[0], 0);
            EXPECT_LE(p[0], 1);
            EXPECT_NEAR(p[0], p[1], invisible);
            EXPECT_NEAR(p[0], p[2], invisible);
            before = p[0];
        }
        EXPECT_LT(show(color, display, "ACES SDR", grey(0))[0], 1.0f / 255); // no visible lift of black
        EXPECT_GT(before, 254.0f / 255);                                     // white is reached
        // A tone curve, not a clip: one stop above diffuse white still differs from two stops.
        EXPECT_LT(show(color, display, "ACES SDR", grey(2))[0] + 2.0f / 255, show(color, display, "ACES SDR", grey(4))[0]);
    }
}

TEST(Exposure, OneStopDoublesTheInput) {
    const auto color = shipped_config();
    const Pixel p{0.11f, 0.2f, 0.04f}, doubled{0.22f, 0.4f, 0.08f};
    for (const auto& display : all_displays)
        for (const auto& view : all_views) EXPECT_EQ(show(color, display, view, p, 1), show(color, display, view, doubled)) << view;
}

TEST(Gamma, IsAPowerOfTheEncodedValue) {
    const auto color = shipped_config();
    const Pixel plain = show(color, "sRGB", "Standard", {0.11f, 0.2f, 0.04f});
    const Pixel lifted = show(color, "sRGB", "Standard", {0.11f, 0.2f, 0.04f}, 0, 2);
    for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(lifted[i], std::sqrt(plain[i]), invisible);
}

TEST(HostilePixels, GiveFiniteOutputInRange) {
    const auto color = shipped_config();
    constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> values{nan,
                                    inf,
                                    -inf,
                                    -1,
                                    -0.0f,
                                    0,
                                    std::numeric_limits<float>::max(),
                                    -std::numeric_limits<float>::max(),
                                    std::numeric_limits<float>::denorm_min(),
                                    1e20f,
                                    0.5f};
    std::vector<float> rgb;
    for (const float r : values)
        for (const float g : values)
            for (const float b : values) rgb.insert(rgb.end(), {r, g, b});
    for (const auto& display : all_displays)
        for (const auto& view : all_views)
            for (const float ev : {0.0f, -200.0f, 200.0f, nan})
                for (const float gamma : {1.0f, 0.0f, -3.0f, nan}) {
                    std::vector<float> shown = rgb;
                    ASSERT_TRUE(color.apply_display({display, view}, {.exposure_ev = ev, .gamma = gamma}, shown.data(), shown.size() / 3));
                    for (const float x : shown) ASSERT_TRUE(x >= 0 && x <= 1) << display << ' ' << view << ' ' << x;
                }
    expect_near(show(color, "sRGB", "Standard", {nan, 1, nan}), {0, 1, 0}); // NaN becomes 0, other channels are unchanged
}

TEST(Images, EveryPixelIsTreatedAlike) {
    const auto color = shipped_config();
    const Pixel p{0.3f, 0.2f, 0.1f};
    std::vector<float> image;
    for (int i = 0; i < 10007; ++i) image.insert(image.end(), p.begin(), p.end());
    ASSERT_TRUE(color.apply_display({}, {.exposure_ev = 0.5f, .gamma = 1.1f}, image.data(), image.size() / 3));
    const Pixel alone = show(color, "", "", p, 0.5f, 1.1f);
    for (size_t i = 0; i < image.size(); ++i) ASSERT_EQ(image[i], alone[i % 3]);
    EXPECT_TRUE(color.apply_display({}, {}, nullptr, 0));
}

TEST(Shader, EveryDisplayAndViewHasOne) {
    const auto color = shipped_config();
    for (const auto& display : all_displays)
        for (const auto& view : all_views) {
            const auto shader = color.display_shader({display, view});
            ASSERT_TRUE(shader) << shader.error().text();
            for (const char* part : {"vec4 display_color(vec4 scene_linear)", "uniform float exposure_ev;", "uniform float gamma;"})
                EXPECT_NE(shader->text.find(part), std::string::npos) << part;
            EXPECT_EQ(shader->text.find("#version"), std::string::npos); // the caller's
            for (const auto& lut : shader->luts) {
                EXPECT_NE(shader->text.find("sampler" + std::to_string(lut.dimensions) + "D " + lut.sampler), std::string::npos);
                EXPECT_EQ(lut.values.size(), size_t(lut.width * lut.height * lut.depth * lut.channels));
            }
        }
}

} // namespace
} // namespace blush::TEST_FILE
