// Invalid input: non-finite numbers, inconsistent sizes, damaged weights.
#include "tests/render/denoise/agreement.h"

#include "core/files.h"
#include "measure/stability/rendered_image.h"
#include "measure/stability/scenes.h"
#include "render/session/denoised_image.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blush::test::TEST_FILE {
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

TEST(DenoiserHostile, OnlyBadPixels) {
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

// A floor with one texel that overflows: its samples are dropped, and the gap in the image affects only its neighbourhood. The
// threshold is the difference of two valid renders with different seeds.
TEST(DenoiserHostile, DroppedSamplesDoNotSpread) {
    constexpr int side = 128, texels = 16, reach = 40;
    const auto image = [&](float odd_one, uint32_t seed) {
        std::vector<Vec3> values(texels * texels, Vec3{1, 1, 1});
        values[0] = {odd_one, odd_one, odd_one};
        Scene scene;
        Material material = stability::emitter(5, 0.7f);
        material.emissive_texture.texture = stability::add_texture(scene, stability::float_image(texels, texels, values));
        stability::place(scene, stability::floor_quad(1), material);
        stability::constant_world(scene, 1);
        scene.view = stability::looking_down(1, 1);
        RenderSettings settings = stability::settings_for(side, side, 4);
        settings.seed = seed;
        return stability::render_anything(scene, settings, {.albedo = true, .normal = true}).frame;
    };
    const Frame sound = image(1, 0), other = image(1, 1), broken = image(3e38f, 0);
    EXPECT_EQ(sound.health.dropped(), 0);
    EXPECT_GT(broken.health.dropped(), 0);
    Denoiser denoiser(BLUSH_WEIGHTS, 2);
    for (const DenoiseQuality quality : {DenoiseQuality::fast, DenoiseQuality::high}) {
        const auto denoised_of = [&](const Frame& frame) {
            const auto made = denoiser.denoise(denoise_inputs(frame).front(), {.quality = quality, .exposure_scale = 0.36f});
            EXPECT_TRUE(made && *made);
            return **made;
        };
        const Denoised with = denoised_of(broken), without = denoised_of(sound), again = denoised_of(other);
        EXPECT_TRUE(all_good(with));
        EXPECT_EQ(with.sanitised, 0) << "dropped samples never reach the denoiser";
        double largest = 0, usual = 0;
        for (size_t i = 0; i < with.rgb.size(); ++i) {
            const size_t x = i / 3 % side, y = i / 3 / side;
            const bool near = x < reach || y < reach || x >= side - reach || y >= side - reach;
            if (!near) largest = std::max(largest, double(std::abs(with.rgb[i] - without.rgb[i])));
            usual = std::max(usual, double(std::abs(again.rgb[i] - without.rgb[i])));
        }
        EXPECT_LE(largest, usual) << int(quality);
    }
}

TEST(DenoiserHostile, InconsistentSizes) {
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
    // After repair, they are read.
    ASSERT_TRUE(write_file(folder / "rt_hdr_small.tza", *whole));
    EXPECT_TRUE(denoiser.denoise(planes.input(), {}));
}

} // namespace
} // namespace blush::test::TEST_FILE
