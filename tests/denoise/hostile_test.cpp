// Input that is not a picture: numbers that are none, sizes that do not fit, damaged weights.
#include "denoise/agreement.h"

#include "core/files.h"
#include "support/process.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blush::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();

bool all_good(const Denoised& made) {
    return std::ranges::all_of(made.rgb, [](float x) { return std::isfinite(x) && x >= 0; });
}

TEST(DenoiserHostile, BadPixelsAreSanitisedAndCounted) {
    const float odd[]{nan, infinite, -infinite, -1, 1e30f, std::numeric_limits<float>::max()};
    Planes planes = noisy_planes(120, 100);
    for (size_t i = 0; i < std::size(odd); i++) planes.color[(1000 * i + 50) * 3 + i % 3] = odd[i];
    for (const DenoiseQuality quality : {DenoiseQuality::fast, DenoiseQuality::high}) {
        const Denoised made = denoised(planes, {.quality = quality, .exposure_scale = 0.36f});
        EXPECT_EQ(made.sanitised, std::ssize(odd));
        EXPECT_TRUE(all_good(made));
        EXPECT_TRUE(std::isfinite(made.mean_before) && std::isfinite(made.mean_after));
    }
}

TEST(DenoiserHostile, NothingButBadPixels) {
    Denoiser denoiser(BLUSH_WEIGHTS, 2);
    for (const float value : {nan, infinite, -infinite, -1.f, 0.f, 1e-45f, 1e30f, std::numeric_limits<float>::max()}) {
        const Denoised made = denoised(denoiser, constant_planes(20, 20, value), {});
        EXPECT_TRUE(all_good(made)) << value;
        EXPECT_TRUE(std::isfinite(made.exposure_scale) && made.exposure_scale > 0) << value;
    }
}

TEST(DenoiserHostile, BadFeatures) {
    Planes planes = noisy_planes(60, 60);
    for (size_t i = 0; i < planes.albedo.size(); i += 7) planes.albedo[i] = i % 2 ? nan : -infinite;
    for (size_t i = 0; i < planes.normal.size(); i += 5) planes.normal[i] = i % 2 ? infinite : nan;
    for (const DenoiseQuality quality : {DenoiseQuality::base, DenoiseQuality::high}) {
        const Denoised made = denoised(planes, {.quality = quality});
        EXPECT_TRUE(all_good(made));
        EXPECT_EQ(made.sanitised, 0) << "only colours are counted";
    }
}

TEST(DenoiserHostile, SizesThatDoNotFit) {
    Denoiser denoiser(BLUSH_WEIGHTS, 1);
    const Planes planes = constant_planes(10, 10, 1);
    const auto refused = [&](auto change) {
        DenoiseInput input = planes.input();
        DenoiseOptions options;
        change(input, options);
        return !denoiser.denoise(input, options);
    };
    EXPECT_FALSE(refused([](auto&, auto&) {}));
    EXPECT_TRUE(refused([](DenoiseInput& in, auto&) { in.width = 0; }));
    EXPECT_TRUE(refused([](DenoiseInput& in, auto&) { in.height = -1; }));
    EXPECT_TRUE(refused([](DenoiseInput& in, auto&) { in.width = 11; }));
    EXPECT_TRUE(refused([](DenoiseInput& in, auto&) { in.width = in.height = std::numeric_limits<int>::max(); }));
    EXPECT_TRUE(refused([](DenoiseInput& in, auto&) { in.color = {}; }));
    EXPECT_TRUE(refused([](DenoiseInput& in, auto&) { in.color.stride = 4; }));
    EXPECT_TRUE(refused([](DenoiseInput& in, auto&) { in.color.stride = -3; }));
    EXPECT_TRUE(refused([](DenoiseInput& in, auto&) { in.albedo.values = in.albedo.values.first(10); }));
    EXPECT_TRUE(refused([](DenoiseInput& in, auto&) { in.normal.values = in.normal.values.first(299); }));
    for (const float scale : {0.f, -1.f, nan, infinite, 1e-40f})
        EXPECT_TRUE(refused([&](auto&, DenoiseOptions& options) { options.exposure_scale = scale; })) << scale;
}

TEST(DenoiserHostile, DamagedWeightsAreAnError) {
    const TemporaryFolder folder;
    const auto whole = read_file(std::string(BLUSH_WEIGHTS) + "/rt_hdr_small.tza", 1 << 24);
    ASSERT_TRUE(whole) << whole.error().text();
    const std::vector<uint8_t> half(whole->begin(), whole->begin() + long(whole->size() / 2));
    ASSERT_TRUE(write_file(folder / "rt_hdr_small.tza", half));
    Denoiser denoiser(folder.path(), 1);
    const Planes planes = constant_planes(8, 8, 1).without_features();
    const auto made = denoiser.denoise(planes.input(), {});
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().text().find("rt_hdr_small.tza"), std::string::npos) << made.error().text();
    // Put right, they are read.
    ASSERT_TRUE(write_file(folder / "rt_hdr_small.tza", *whole));
    EXPECT_TRUE(denoiser.denoise(planes.input(), {}));
}

} // namespace
} // namespace blush::test
