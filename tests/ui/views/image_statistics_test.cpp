// Statistics of the displayed image: region statistics and scopes against manual sums.
#include "core/text.h"
#include "io/image/display_image.h"
#include "render/film/coverage.h"
#include "tests/ui/shipped_ocio_config.h"
#include "ui/snapshots/region_statistics.h"
#include "ui/viewport/view_tools.h"
#include "ui/views/meters_view.h"
#include "ui/views/scopes_view.h"
#include "ui/widgets/waveform_sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace blush::TEST_FILE {
namespace {

TEST(Numbers, ZeroHasNoSign) {
    EXPECT_EQ(signed_number(-0.001, 2), "0.00");
    EXPECT_EQ(signed_number(0.001, 2), "0.00");
    EXPECT_EQ(signed_number(-0.006, 2), "-0.01");
    EXPECT_EQ(signed_number(12.345, 1), "+12.3");
    EXPECT_EQ(without_sign_of_zero("-0.00 %"), "0.00 %");
    EXPECT_EQ(without_sign_of_zero("-0.0"), "0.0");
    EXPECT_EQ(without_sign_of_zero("-0.10 %"), "-0.10 %");
    EXPECT_EQ(without_sign_of_zero("-0.000e+00"), "-0.000e+00");
    EXPECT_EQ(without_sign_of_zero("-inf"), "-inf");
    EXPECT_EQ(without_sign_of_zero("-"), "-");
}

class Figures : public testing::Test {
protected:
    // 8 x 4 pixels whose red is their column, green their row, blue 0.25; the last one black.
    ShownImage image() {
        auto frame = std::make_shared<Frame>();
        frame->width = 8;
        frame->height = 4;
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 8; ++x) frame->rgba.insert(frame->rgba.end(), {float(x), float(y), 0.25f, 1});
        std::fill_n(frame->rgba.end() - 4, 3, 0.f);
        return {frame, nullptr, {}, {}, &color};
    }
    const ColorManagement color = test::our_colors();
};

TEST_F(Figures, RegionHasTheStatisticsOfItsPixels) {
    ShownImage p = image();
    p.view.exposure_ev = 1.5f;
    p.view.white = {1, 0.8f, 0.6f};
    p.view.measured = ImageRegion{2 / 8.f, 1 / 4.f, 3 / 8.f, 2 / 4.f}; // columns 2 .. 4, rows 1 .. 2
    const RegionStatistics s = region_statistics(p);
    EXPECT_EQ(s.x, 2);
    EXPECT_EQ(s.y, 1);
    EXPECT_EQ(s.width, 3);
    EXPECT_EQ(s.height, 2);
    EXPECT_DOUBLE_EQ(s.linear[0].mean, 3);
    EXPECT_DOUBLE_EQ(s.linear[0].low, 2);
    EXPECT_DOUBLE_EQ(s.linear[0].high, 4);
    EXPECT_DOUBLE_EQ(s.linear[0].deviation, std::sqrt(2 / 3.0));
    EXPECT_DOUBLE_EQ(s.linear[1].mean, 1.5);
    EXPECT_DOUBLE_EQ(s.linear[2].deviation, 0);
    EXPECT_NEAR(s.nits.mean, 0.212671 * 3 + 0.715160 * 1.5 + 0.072169 * 0.25, 1e-6);

    const DisplayParameters numbers = display_parameters_of(p.view);
    std::vector<float> shown, ev, ev100;
    for (const float y : {1.f, 2.f})
        for (const float x : {2.f, 3.f, 4.f}) {
            shown.insert(shown.end(), {x, y, 0.25f});
            const Affine& m = numbers.white_balance;
            const auto component = [&](float a, float b, float c) { return a * x + b * y + c * 0.25f; };
            const double balanced = 0.212671 * component(m.x.x, m.y.x, m.z.x) + 0.715160 * component(m.x.y, m.y.y, m.z.y) +
                                    0.072169 * component(m.x.z, m.y.z, m.z.z);
            ev.push_back(float(std::log2(balanced * std::exp2(1.5) / 0.18)));
            ev100.push_back(float(std::log2((0.212671 * x + 0.715160 * y + 0.072169 * 0.25) * 100 / 12.5)));
        }
    EXPECT_NEAR(s.ev.mean, value_statistics(ev).mean, 1e-5);
    EXPECT_NEAR(s.ev.high, value_statistics(ev).high, 1e-5);
    EXPECT_NEAR(s.ev100.deviation, value_statistics(ev100).deviation, 1e-5);
    ASSERT_TRUE(color.apply_display({}, numbers, shown.data(), 6));
    for (size_t k = 0; k < 3; ++k) {
        double mean = 0;
        for (size_t i = 0; i < 6; ++i) mean += double(shown[3 * i + k]) / 6;
        EXPECT_NEAR(s.displayed[k].mean, mean, 1e-7);
    }
}

TEST_F(Figures, RegionSmallerThanAPixelHasThatPixel) {
    ShownImage p = image();
    p.view.measured = ImageRegion{0.999f, 0.999f, 0.0005f, 0.0005f};
    const RegionStatistics s = region_statistics(p);
    EXPECT_EQ(s.width * s.height, 1);
    EXPECT_EQ(s.linear[0].mean, 0);
    EXPECT_EQ(s.ev.count, 0) << "black has no EV";
    EXPECT_EQ(s.nits.count, 1);
}

TEST_F(Figures, ScopesCountEveryPixelOfASmallImage) {
    const Scopes s = scopes_of(image());
    EXPECT_EQ(s.step, 1);
    for (const Histogram* h : {&s.scene, &s.displayed})
        for (size_t k = 0; k < scope_channels; ++k)
            EXPECT_EQ(std::accumulate(h->counts[k].begin(), h->counts[k].end(), h->below[k] + h->above[k]), 32);
    EXPECT_EQ(s.scene.below[3], 1) << "the black pixel has no logarithm";
    EXPECT_EQ(s.displayed.below[3] + s.displayed.above[3], 0) << "the display clips";
    EXPECT_EQ(s.displayed_wave.columns, 8);
}

TEST_F(Figures, ScopesOfALargeImageUseAGridOfPixels) {
    auto frame = std::make_shared<Frame>();
    frame->width = 1280;
    frame->height = 720;
    frame->rgba.assign(size_t(1280) * 720 * 4, 0.18f);
    const Scopes s = scopes_of({frame, nullptr, {}, {}, &color});
    EXPECT_EQ(s.step, 2);
    EXPECT_EQ(s.scene.pixels, 640 * 360);
    EXPECT_EQ(s.scene.counts[3][64], uint32_t(640 * 360)) << "middle grey is in the middle";
}

TEST_F(Figures, WaveformRowsStartWithTheHighestLevel) {
    const float rgb[] = {1, 0, 0, 0, 0, 1}; // a red pixel beside a blue one
    const std::vector<uint32_t> texels = waveform_texels(waveform(rgb, 2, {false, 0, 1}, 2, 4));
    ASSERT_EQ(texels.size(), 8u);
    EXPECT_EQ(texels[0], IM_COL32(70, 0, 0, 255));
    EXPECT_EQ(texels[1], IM_COL32(0, 0, 70, 255));
    EXPECT_EQ(texels[2], 0u) << "empty between";
    EXPECT_EQ(texels[6], IM_COL32(0, 70, 70, 255)) << "what is missing in the left column is at black";
    EXPECT_EQ(texels[7], IM_COL32(70, 70, 0, 255));
}

TEST_F(Figures, PickedColourIsAMeanOfPixels) {
    const ShownImage p = image();
    const Vec3 c = picked_color(*p.frame, nullptr, {}, 3.5 / 8, 1.5 / 4, 1);
    EXPECT_FLOAT_EQ(c.x, 3);
    EXPECT_FLOAT_EQ(c.y, 1);
    const Vec3 corner = picked_color(*p.frame, nullptr, {}, 0, 0, 1);
    EXPECT_FLOAT_EQ(corner.x, 0.5f) << "of the existing pixels";
}

TEST(Coverage, IsWhereObjectsAre) {
    Frame f;
    f.rgba = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0.25f};
    EXPECT_EQ(coverage_of(f), (std::vector<float>{1, 1, 0.25f})) << "without ids everything is an object";
    f.object_id = {0, 7, 0};
    EXPECT_EQ(coverage_of(f), (std::vector<float>{0, 1, 0.25f})) << "alpha is exact where there is one";
}

TEST(Meters, ReadingHasTheDecimalsOfItsInterval) {
    EXPECT_EQ(reading_text({.rounds = 9, .lux = {true, 342.345, 338.2, 346.6}}), "342.3 ± 4.2 lx");
    EXPECT_EQ(reading_text({.rounds = 9, .lux = {true, 34234.4, 34100, 34368}}), "34234 ± 134 lx");
    EXPECT_EQ(reading_text({}), "...");
    EXPECT_EQ(new_meter_name({{"Meter 1"}, {"Desk"}, {"Meter 3"}}), "Meter 2");
}

TEST(FalseColorFit, IsRoundNumbersAroundTheImage) {
    const auto fit = [](float low, float high) {
        return fitted({.of = FalseColor::Of::nits}, std::vector<float>{low, low, low, high, high, high, high, high, high}, 3);
    };
    EXPECT_EQ(fit(0.7f, 180), (FalseColor{FalseColor::Of::nits, 0.5f, 200}));
    EXPECT_EQ(fit(2.1f, 3).low, 2);
    EXPECT_EQ(fit(2.1f, 3).high, 5);
    EXPECT_EQ(fit(1.5f, 90).high, 100);
    EXPECT_EQ(fit(0, 0), (FalseColor{.of = FalseColor::Of::nits})) << "black has no range";
}

TEST(ImageRectangles, AreTheSameFromEveryCornerAndWithinTheImage) {
    const ImageRegion wanted{0.25f, 0.5f, 0.5f, 0.25f};
    EXPECT_EQ(region_between(0.25, 0.5, 0.75, 0.75), wanted);
    EXPECT_EQ(region_between(0.75, 0.75, 0.25, 0.5), wanted);
    EXPECT_EQ(region_between(0.75, 0.5, 0.25, 0.75), wanted);
    EXPECT_EQ(region_between(-3, -1, 4, 0.5), (ImageRegion{0, 0, 1, 0.5f}));
}

} // namespace
} // namespace blush::TEST_FILE
