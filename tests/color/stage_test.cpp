// Display stage besides the views: looks, white balance, metering, false colour, and unmodified background.
#include "color/exposure_meter.h"
#include "color/illuminance.h"
#include "color/white_balance.h"
#include "core/math.h"
#include "tests/color/shipped_config.h"

#include <limits>
#include <random>
#include <vector>

namespace blush::TEST_FILE {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();

Pixel show_with(const ColorManagement& color, const DisplayTransform& transform, const DisplayParameters& numbers, Pixel pixel) {
    EXPECT_TRUE(color.apply_display(transform, numbers, pixel.data(), 1));
    return pixel;
}

TEST(Looks, PivotAtMiddleGreyOrDesaturate) {
    const auto color = shipped_config();
    const auto standard = [&](const char* look, const Pixel& p) { return show_with(color, {"sRGB", "Standard", look}, {}, p); };
    for (const char* look : {"Low contrast", "High contrast"}) {
        const Pixel same = standard(look, grey(0.18f));
        for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(same[i], standard("", grey(0.18f))[i], 1e-4) << look;
    }
    // The unit range of ACEScct is 17.52 stops, so contrast scales stops from grey.
    EXPECT_NEAR(standard("High contrast", grey(0.18f * 2))[0], srgb_encoded(0.18 * std::exp2(1.2)), 1e-3);
    EXPECT_NEAR(standard("Low contrast", grey(0.18f / 2))[0], srgb_encoded(0.18 * std::exp2(-1 / 1.2)), 1e-3);
    const Pixel mixed{0.8f, 0.3f, 0.05f}, plain = standard("Black and white", mixed);
    for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(plain[i], srgb_encoded(luminance(mixed)), 1e-3);
}

TEST(Looks, AreAvailableInEveryView) {
    const auto color = shipped_config();
    EXPECT_EQ(color.looks(), (std::vector<std::string>{"Low contrast", "High contrast", "Black and white"}));
    for (const auto& look : color.looks())
        for (const auto& display : color.displays())
            for (const auto& view : color.views(display)) EXPECT_TRUE(color.display_shader({display, view, look})) << look << view;
}

TEST(WhiteBalance, MakesThePickedColourNeutralAndKeepsItsLuminance) {
    std::mt19937 rng(5);
    std::uniform_real_distribution<float> component(0, 1);
    std::vector<Vec3> picked{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0.6f, 0.2f}, {1e-6f, 2e-6f, 3e-6f}, {1e6f, 2e6f, 1.5e6f}};
    for (int i = 0; i < 1000; ++i) picked.push_back({component(rng), component(rng), component(rng)});
    for (const Vec3& p : picked) {
        const Vec3 shown = transform_vector(white_balance(p), p);
        const float y = 0.2126729f * p.x + 0.7151522f * p.y + 0.0721750f * p.z;
        for (const float c : {shown.x, shown.y, shown.z}) EXPECT_NEAR(c / y, 1, 1e-5) << p.x << ' ' << p.y << ' ' << p.z;
    }
}

// Lindbloom's published Bradford matrix from illuminant A to D65, applied in XYZ.
TEST(WhiteBalance, IsTheBradfordAdaptation) {
    const Affined a_to_d65{
        {0.8446965, -0.1366303, 0.0798489}, {-0.1179225, 1.1041226, -0.1348999}, {0.3948108, 0.1291718, 3.1924009}, {0, 0, 0}};
    const Affined xyz_from_rgb{
        {0.4124564, 0.2126729, 0.0193339}, {0.3575761, 0.7151522, 0.1191920}, {0.1804375, 0.0721750, 0.9503041}, {0, 0, 0}};
    const Vec3d white_a = transform_vector(inverse(xyz_from_rgb), Vec3d{1.09850, 1, 0.35585});
    const Affine balance = white_balance({float(white_a.x), float(white_a.y), float(white_a.z)});
    for (const Vec3d& rgb : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
        const Vec3d wanted = transform_vector(inverse(xyz_from_rgb) * (a_to_d65 * xyz_from_rgb), rgb);
        const Vec3 got = transform_vector(balance, Vec3{float(rgb.x), float(rgb.y), float(rgb.z)});
        EXPECT_NEAR(got.x, wanted.x, 2e-4);
        EXPECT_NEAR(got.y, wanted.y, 2e-4);
        EXPECT_NEAR(got.z, wanted.z, 2e-4);
    }
}

TEST(WhiteBalance, IgnoresGreysAndInvalidColours) {
    for (const Vec3& p : {Vec3{1, 1, 1}, Vec3{0.3f, 0.3f, 0.3f}, Vec3{0, 0, 0}, Vec3{-1, 1, 1}, Vec3{nan, 1, 1}, Vec3{inf, 1, 1}})
        EXPECT_EQ(white_balance(p), Affine{});
}

TEST(WhiteBalance, IsAppliedBeforeTheView) {
    const auto color = shipped_config();
    const Pixel shown = show_with(color, {"sRGB", "Standard"}, {.white_balance = white_balance({1, 0.6f, 0.2f})}, {0.5f, 0.3f, 0.1f});
    const double y = 0.2126729 * 0.5 + 0.7151522 * 0.3 + 0.0721750 * 0.1;
    for (const float c : shown) EXPECT_NEAR(c, srgb_encoded(y), invisible);
}

std::vector<float> image(std::initializer_list<std::pair<int, float>> runs) {
    std::vector<float> rgb;
    for (const auto& [count, value] : runs) rgb.insert(rgb.end(), size_t(count) * 3, value);
    return rgb;
}

TEST(ExposureMeter, AverageBringsTheGeometricMeanToMiddleGrey) {
    EXPECT_NEAR(average_exposure(image({{100, 0.18f}}), 3), 0, 1e-6);
    EXPECT_NEAR(average_exposure(image({{100, 0.72f}}), 3), -2, 1e-6);
    EXPECT_NEAR(average_exposure(image({{50, 0.18f * 16}, {50, 0.18f / 4}}), 3), -1, 1e-5); // (4 - 2) / 2 stops above grey
    EXPECT_NEAR(average_exposure(image({{50, 0.36f}, {70, 0}, {10, nan}, {10, -1}}), 3), -1, 1e-6) << "black pixels are ignored";
    EXPECT_EQ(average_exposure(image({{10, 0}}), 3), 0);
    EXPECT_EQ(average_exposure({}, 3), 0);
}

// Sunny 16: at f/16 and 1/100 s, ISO 100 film is well exposed at EV 14.64, where a meter with K = 12.5 reads 0.125 * 2^EV nits.
TEST(CameraExposure, ShowsTheMeteredLuminanceAsMiddleGrey) {
    const double ev = std::log2(16. * 16 * 100), nits = 0.125 * std::exp2(ev);
    EXPECT_NEAR(nits * std::exp2(double(camera_exposure(16, 0.01f, 100))), 0.18, 1e-6);
    const float stops = camera_exposure(8, 1 / 125.f, 100);
    EXPECT_NEAR(camera_exposure(8, 1 / 125.f, 400), stops + 2, 1e-5) << "four times the sensitivity";
    EXPECT_NEAR(camera_exposure(8, 1 / 500.f, 100), stops - 2, 1e-5) << "a quarter of the time";
    EXPECT_NEAR(camera_exposure(4, 1 / 125.f, 100), stops + 2, 1e-5) << "four times the area";
}

TEST(ExposureMeter, HighlightsBringsThe99thPercentileToWhite) {
    EXPECT_NEAR(highlight_exposure(image({{970, 0.1f}, {30, 8}}), 3), -3, 1e-6);
    EXPECT_NEAR(highlight_exposure(image({{995, 0.25f}, {5, 1000}}), 3), 2, 1e-6) << "half a per cent of pixels is ignored";
    EXPECT_EQ(highlight_exposure({}, 4), 0);
}

TEST(ExposureMeter, RangeLeavesOutOnePerCentAtEitherEnd) {
    const LuminanceRange range = luminance_range(image({{5, 1e-6f}, {500, 2}, {490, 30}, {5, 1e6f}}), 3);
    EXPECT_NEAR(range.low, 2, 1e-6);
    EXPECT_NEAR(range.high, 30, 1e-5);
    EXPECT_EQ(luminance_range(image({{5, 0}}), 3).high, 0);
}

TEST(ExposureMeter, ReadsRgbaAndLargeImagesAlike) {
    EXPECT_NEAR(average_exposure(std::vector<float>{0.36f, 0.36f, 0.36f, 1, 0.36f, 0.36f, 0.36f, 0}, 4), -1, 1e-6);
    std::vector<float> large;
    std::mt19937 rng(3);
    std::normal_distribution<float> stops(2, 1);
    for (int i = 0; i < 300000; ++i) large.insert(large.end(), 3, 0.18f * std::exp2(stops(rng)));
    // 75000 of the pixels are read: five standard errors of the mean of stops, whose deviation is 1.
    EXPECT_NEAR(average_exposure(large, 3), -2, 5 / std::sqrt(75000.0));
}

constexpr FalseColorScale one_to_thousand{FalseColorScale::Of::scene, 0, 10}; // log2

TEST(FalseColor, BandsLieBetweenTheirEdges) {
    EXPECT_EQ(false_color_band(0, one_to_thousand), 0);
    EXPECT_EQ(false_color_band(-1, one_to_thousand), 0);
    EXPECT_EQ(false_color_band(nan, one_to_thousand), 0);
    EXPECT_EQ(false_color_band(inf, one_to_thousand), false_color_bands + 1);
    EXPECT_EQ(false_color_edge(1, one_to_thousand), 0);
    EXPECT_FLOAT_EQ(false_color_edge(false_color_bands + 1, one_to_thousand), 10);
    for (int band = 1; band <= false_color_bands + 1; ++band) {
        const float edge = false_color_edge(band, one_to_thousand);
        EXPECT_EQ(false_color_band(std::exp2(edge) * 0.9999f, one_to_thousand), band - 1);
        EXPECT_EQ(false_color_band(std::exp2(edge) * 1.0001f, one_to_thousand), band);
    }
}

TEST(FalseColor, ColoursAreDistinguishable) {
    for (size_t i = 0; i < false_colors.size(); ++i)
        for (size_t j = 0; j < i; ++j) EXPECT_GT(length(false_colors[i] - false_colors[j]), 30.0f / 255) << i << ' ' << j;
}

TEST(FalseColor, ReplacesTheViewOnEveryDisplay) {
    const auto color = shipped_config();
    for (const auto& display : color.displays()) {
        DisplayParameters numbers{.exposure_ev = 3, .gamma = 2, .false_color = one_to_thousand};
        const Pixel scene = show_with(color, {display}, numbers, {0.4f, 2.3f, 0.9f});
        numbers.false_color.of = FalseColorScale::Of::exposed;
        const Pixel exposed = show_with(color, {display}, numbers, {0.4f, 2.3f, 0.9f});
        const float y = luminance(Pixel{0.4f, 2.3f, 0.9f});
        const Vec3 wanted = false_colors[size_t(false_color_band(y, one_to_thousand))],
                   brighter = false_colors[size_t(false_color_band(8 * y, one_to_thousand))];
        EXPECT_EQ(scene, (Pixel{wanted.x, wanted.y, wanted.z}));
        EXPECT_EQ(exposed, (Pixel{brighter.x, brighter.y, brighter.z}));
        EXPECT_NE(scene, exposed);
    }
}

TEST(Background, AsItIsIsOnlyClippedAndEncoded) {
    const auto color = shipped_config();
    const DisplayParameters numbers{
        .exposure_ev = -3, .gamma = 2, .white_balance = white_balance({1, 0.5f, 0.2f}), .background_as_it_is = true};
    const Pixel p{0.2f, 0.5f, 3};
    std::vector<float> rgb;
    for (int i = 0; i < 3; ++i) rgb.insert(rgb.end(), p.begin(), p.end());
    const float coverage[] = {0, 0.25f, 1};
    ASSERT_TRUE(color.apply_display({}, numbers, rgb.data(), 3, coverage));
    const Pixel object = show_with(color, {}, numbers, p);
    for (size_t i = 0; i < 3; ++i) {
        const double background = srgb_encoded(std::min(double(p[i]), 1.0));
        EXPECT_NEAR(rgb[i], background, 1e-6);
        EXPECT_NEAR(rgb[3 + i], 0.75 * background + 0.25 * object[i], 1e-6);
        EXPECT_EQ(rgb[6 + i], object[i]);
    }
}

TEST(Illuminance, IsPiTimesRadianceOverAlbedo) {
    std::vector<float> rgb{0.5f, 0.5f, 0.5f, 0.2f, 0.1f, 0.4f, 3, 3, 3};
    const std::vector<Vec3> albedo{{0.25f, 0.25f, 0.25f}, {0.4f, 0.2f, 0.8f}, {0, 0, 0}};
    to_illuminance(rgb, albedo);
    EXPECT_FLOAT_EQ(rgb[0], 2 * pi);
    EXPECT_NEAR(rgb[4], pi / 2, 1e-6);
    EXPECT_EQ(rgb[8], 0) << "a black surface gives no illuminance";
}

} // namespace
} // namespace blush::TEST_FILE
