// The public interface of the denoiser: sizes, tiles, threads, cancellation, cold and warm starts, reported statistics.
#include "tests/render/denoise/agreement.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

namespace blush::test::TEST_FILE {
namespace {

bool all_good(const Denoised& made) {
    return std::ranges::all_of(made.rgb, [](float x) { return std::isfinite(x) && x >= 0; });
}

double mean_of(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size()); }

TEST(Denoiser, AnySize) {
    Denoiser denoiser(BLUSH_WEIGHTS, 2);
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 40}, {15, 17}, {16, 16}, {33, 1}, {200, 152}})
        for (const DenoiseQuality quality : {DenoiseQuality::fast, DenoiseQuality::base, DenoiseQuality::high}) {
            const Denoised made = denoised(denoiser, noisy_planes(width, height), {.quality = quality});
            EXPECT_EQ(made.rgb.size(), size_t(width) * height * 3);
            EXPECT_TRUE(all_good(made)) << width << "x" << height;
            EXPECT_GT(mean_of(made.rgb), 0);
            EXPECT_EQ(made.tiles, 1);
        }
}

TEST(Denoiser, ALargeOddSize) {
    const Denoised made = denoised(noisy_planes(1921, 1081), {});
    EXPECT_EQ(made.rgb.size(), size_t(1921) * 1081 * 3);
    EXPECT_TRUE(all_good(made));
    EXPECT_NEAR(made.mean_after / made.mean_before, 1, 0.05);
}

TEST(Denoiser, AConstantImageKeepsItsMean) {
    Denoiser denoiser(BLUSH_WEIGHTS, 2);
    for (const DenoiseQuality quality : {DenoiseQuality::fast, DenoiseQuality::base, DenoiseQuality::high})
        for (const float value : {1e-4f, 0.3f, 1e5f}) {
            Planes planes = constant_planes(96, 80, value);
            for (int times = 0; times < 2; times++) {
                const Denoised made = denoised(denoiser, planes, {.quality = quality});
                EXPECT_NEAR(mean_of(made.rgb), value, 0.01 * value) << "quality " << int(quality);
                EXPECT_NEAR(made.mean_after / made.mean_before, 1, 0.01);
                planes.color = made.rgb;
            }
        }
}

TEST(Denoiser, ReportsMeanLuminances) {
    const Denoised made = denoised(constant_planes(40, 30, 0.25f), {});
    EXPECT_NEAR(made.mean_before, 0.25, 1e-6);
    double luminance = 0;
    for (size_t i = 0; i < made.rgb.size(); i += 3)
        luminance += 0.212671 * made.rgb[i] + 0.715160 * made.rgb[i + 1] + 0.072169 * made.rgb[i + 2];
    EXPECT_NEAR(made.mean_after, luminance / (40 * 30), 1e-6);
}

// Seams are largest at tile borders, so all pixels must agree.
TEST(Denoiser, TilesAreInvisible) {
    Denoiser denoiser(BLUSH_WEIGHTS, 2);
    const auto check = [&](const Planes& planes, DenoiseQuality quality, int megabytes) {
        DenoiseOptions options{.quality = quality, .precision = DenoisePrecision::float32};
        const Denoised whole = denoised(denoiser, planes, options);
        options.memory_bytes = uint64_t(megabytes) << 20;
        const Denoised tiled = denoised(denoiser, planes, options);
        EXPECT_EQ(whole.tiles, 1);
        EXPECT_GE(tiled.tiles, 2);
        EXPECT_EQ(whole.rgb, tiled.rgb);
    };
    check(noisy_planes(102, 699), DenoiseQuality::fast, 20);
    check(noisy_planes(700, 101), DenoiseQuality::fast, 20);
    check(noisy_planes(500, 60), DenoiseQuality::high, 20);
}

TEST(Denoiser, TooLittleMemoryIsAnError) {
    Denoiser denoiser(BLUSH_WEIGHTS, 2);
    const Planes planes = noisy_planes(500, 420);
    const auto made = denoiser.denoise(planes.input(), {.memory_bytes = 1 << 20});
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().text().find("1 MB"), std::string::npos) << made.error().text();
}

TEST(Denoiser, ThreadsDoNotChangeTheResult) {
    const Planes planes = noisy_planes(150, 90);
    const Denoised one = denoised(planes, {}, 1);
    for (const unsigned threads : {2u, 5u}) EXPECT_EQ(denoised(planes, {}, threads).rgb, one.rgb);
}

// Sizes, networks and precisions one after another: memory contents of earlier calls must have no effect.
TEST(Denoiser, WarmEqualsCold) {
    Denoiser warm(BLUSH_WEIGHTS, 2);
    for (int round = 0; round < 2; round++)
        for (const auto& [width, height] : {std::pair{100, 50}, {20, 90}, {64, 64}})
            for (const DenoiseOptions& options : {DenoiseOptions{.quality = DenoiseQuality::high}, DenoiseOptions{},
                                                  DenoiseOptions{.precision = DenoisePrecision::float32}}) {
                const Planes planes = noisy_planes(width, height);
                EXPECT_EQ(denoised(warm, planes, options).rgb, denoised(planes, options).rgb);
            }
    const Planes planes = noisy_planes(100, 50);
    const Denoised before = denoised(warm, planes, {});
    warm.release();
    EXPECT_EQ(denoised(warm, planes, {}).rgb, before.rgb);
}

TEST(Denoiser, StopsWhenNoLongerWanted) {
    Denoiser denoiser(BLUSH_WEIGHTS, 2);
    const Planes planes = noisy_planes(200, 100);
    std::atomic<int> asked = 0;
    ASSERT_TRUE(denoiser.denoise(planes.input(), {}, [&] { return ++asked > 0; }));
    const int all = asked;
    EXPECT_GT(all, 16 * 2) << "`wanted` is called in every layer";
    for (const int enough : {0, 1, all / 2, all - 1}) {
        asked = 0;
        const auto stopped = denoiser.denoise(planes.input(), {}, [&] { return asked++ < enough; });
        ASSERT_TRUE(stopped) << stopped.error().text();
        EXPECT_FALSE(stopped->has_value()) << "after " << enough << " of " << all;
    }
    EXPECT_EQ(denoised(denoiser, planes, {}).rgb, denoised(planes, {}).rgb);
}

// Per layer and tile, for all networks of the quality: many increasing steps, ending at 1.
TEST(Denoiser, ReportsProgress) {
    Denoiser denoiser(BLUSH_WEIGHTS, 2);
    const Planes planes = noisy_planes(500, 60);
    const auto steps = [&](const DenoiseOptions& options) {
        std::vector<double> told;
        const auto made = denoiser.denoise(planes.input(), options, {}, [&](double share) { told.push_back(share); });
        EXPECT_TRUE(made && *made);
        EXPECT_TRUE(std::ranges::is_sorted(told, std::less_equal())) << "forward only";
        EXPECT_GT(told.front(), 0);
        EXPECT_DOUBLE_EQ(told.back(), 1);
        double largest_step = told.front();
        for (size_t i = 1; i < told.size(); ++i) largest_step = std::max(largest_step, told[i] - told[i - 1]);
        EXPECT_LT(largest_step, 0.4) << "progress has no large jumps";
        return told.size();
    };
    const size_t one = steps({});
    EXPECT_EQ(steps({.quality = DenoiseQuality::high}), 3 * one);
    EXPECT_GT(steps({.quality = DenoiseQuality::high, .precision = DenoisePrecision::float32, .memory_bytes = uint64_t(20) << 20}),
              3 * one);
}

TEST(Denoiser, SharesNothingWithItsInput) {
    Planes planes = noisy_planes(64, 40);
    const Planes copy = planes;
    const Denoised made = denoised(planes, {.quality = DenoiseQuality::high});
    EXPECT_EQ(planes.color, copy.color);
    EXPECT_EQ(planes.albedo, copy.albedo);
    EXPECT_EQ(planes.normal, copy.normal);
    const std::vector<float> before = made.rgb;
    std::ranges::fill(planes.color, 9.f);
    EXPECT_EQ(made.rgb, before);
}

TEST(Denoiser, StridesAreHonoured) {
    const Planes planes = noisy_planes(50, 30);
    std::vector<float> rgba;
    for (size_t i = 0; i < planes.color.size(); i += 3)
        rgba.insert(rgba.end(), {planes.color[i], planes.color[i + 1], planes.color[i + 2], NAN});
    Denoiser denoiser(BLUSH_WEIGHTS, 2);
    DenoiseInput input = planes.input();
    input.color = {rgba, 4};
    const auto made = denoiser.denoise(input, {});
    ASSERT_TRUE(made && *made);
    EXPECT_EQ((*made)->rgb, denoised(planes, {}).rgb);
    EXPECT_EQ((*made)->sanitised, 0);
}

TEST(Denoiser, AGivenExposureScaleIsUsed) {
    const Planes planes = noisy_planes(64, 64);
    const Denoised measured = denoised(planes, {}), again = denoised(planes, {.exposure_scale = measured.exposure_scale});
    EXPECT_EQ(again.rgb, measured.rgb);
    const Denoised other = denoised(planes, {.exposure_scale = 4 * measured.exposure_scale});
    EXPECT_EQ(other.exposure_scale, 4 * measured.exposure_scale);
    EXPECT_NE(other.rgb, measured.rgb);
}

TEST(Denoiser, UsesAvailableFeatures) {
    Planes planes = noisy_planes(40, 40);
    EXPECT_EQ(denoised(planes, {.quality = DenoiseQuality::high}).network, "rt_hdr_calb_cnrm");
    EXPECT_EQ(denoised(planes, {.quality = DenoiseQuality::base}).network, "rt_hdr_alb_nrm");
    EXPECT_EQ(denoised(planes, {}).network, "rt_hdr_alb_nrm_small");
    planes.albedo.clear();
    EXPECT_EQ(denoised(planes, {.quality = DenoiseQuality::high}).network, "rt_hdr");
    EXPECT_EQ(denoised(planes, {}).network, "rt_hdr_small");
    EXPECT_EQ(denoised(planes, {}).rgb, denoised(planes.without_features(), {}).rgb);
}

TEST(Denoiser, NeedsItsWeightsOnlyWhenCalled) {
    Denoiser denoiser("/nowhere", 1);
    const auto made = denoiser.denoise(constant_planes(4, 4, 1).input(), {});
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().text().find("/nowhere/rt_hdr_alb_nrm_small.tza"), std::string::npos) << made.error().text();
    EXPECT_TRUE(find_denoiser_weights(BLUSH_WEIGHTS));
    EXPECT_FALSE(find_denoiser_weights("/nowhere"));
}

} // namespace
} // namespace blush::test::TEST_FILE
