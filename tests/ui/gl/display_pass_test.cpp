// The display shader against ColorManagement::apply_display (used for files), pixel by pixel, for every display, view and look.
// Needs a display, which window_display_test provides.
#include "color/white_balance.h"
#include "core/math.h"
#include "ui/gl/display_pass.h"
#include "ui/window/window.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace blush::TEST_FILE {
namespace {

constexpr int width = 96, height = 48;

// One step of 8 bits, plus the tolerance for GPU arithmetic.
constexpr double tolerance = 1.0 / 255 + 2e-3;

// Scene-linear values from -10 to +10 stops about middle grey in all hues, with alpha for coverage.
std::vector<float> test_image() {
    std::mt19937 rng(1);
    std::uniform_real_distribution<float> stops(-10, 10), hue(0, 1);
    std::vector<float> rgba;
    for (int i = 0; i < width * height; ++i) {
        const float y = 0.18f * std::exp2(stops(rng));
        rgba.insert(rgba.end(), {y * hue(rng), y * hue(rng), y * hue(rng), hue(rng)});
    }
    return rgba;
}

class DisplayPassTest : public testing::Test {
protected:
    static void SetUpTestSuite() {
        auto opened = Window::open({.title = "test", .width = 480, .height = 320, .scale = 1, .assets = BLUSH_ASSETS});
        ASSERT_TRUE(opened) << opened.error().text();
        window = std::move(*opened);
        unsetenv("OCIO");
        auto loaded = ColorManagement::load(BLUSH_ASSETS);
        ASSERT_TRUE(loaded) << loaded.error().text();
        color = std::make_unique<ColorManagement>(std::move(*loaded));
    }
    static void TearDownTestSuite() {
        color.reset();
        window.reset();
    }

    static std::vector<float> drawn(const std::vector<float>& rgba, const DisplayTransform& transform, const DisplayParameters& numbers) {
        DisplayPass pass;
        const auto shader = color->display_shader(transform);
        EXPECT_TRUE(shader);
        const auto set = pass.set_shader(*shader);
        EXPECT_TRUE(set) << set.error().text();
        pass.upload(width, height, rgba);
        pass.begin({numbers, {}});
        while (pass.busy()) pass.advance(1000);
        std::vector<unsigned char> bytes(size_t(width) * height * 4);
        glBindTexture(GL_TEXTURE_2D, pass.texture());
        glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
        std::vector<float> rgb;
        for (size_t i = 0; i < bytes.size(); ++i)
            if (i % 4 != 3) rgb.push_back(float(bytes[i]) / 255);
        return rgb;
    }

    static std::vector<float> computed(const std::vector<float>& rgba, const DisplayTransform& transform,
                                       const DisplayParameters& numbers) {
        std::vector<float> rgb, coverage;
        for (size_t i = 0; i < rgba.size(); ++i) (i % 4 != 3 ? rgb : coverage).push_back(rgba[i]);
        EXPECT_TRUE(color->apply_display(transform, numbers, rgb.data(), rgb.size() / 3, coverage.data()));
        return rgb;
    }

    static void expect_twins(const std::vector<float>& rgba, const DisplayTransform& transform, const DisplayParameters& numbers) {
        const std::vector<float> card = drawn(rgba, transform, numbers), processor = computed(rgba, transform, numbers);
        ASSERT_EQ(card.size(), processor.size());
        double worst = 0;
        for (size_t i = 0; i < card.size(); ++i) worst = std::max(worst, std::abs(double(card[i]) - double(processor[i])));
        EXPECT_LE(worst, tolerance) << transform.display << ", " << transform.view << ", " << transform.look;
    }

    static inline std::unique_ptr<Window> window;
    static inline std::unique_ptr<ColorManagement> color;
};

TEST_F(DisplayPassTest, EveryViewAndLookMatchesFiles) {
    for (const float gamma : {1.f, 1.2f}) { // without and with the steps that most looks leave out
        const DisplayParameters numbers{.exposure_ev = -0.7f, .gamma = gamma, .white_balance = white_balance({1, 0.7f, 0.35f})};
        EXPECT_EQ(numbers.needs_all_steps(), gamma != 1);
        for (const auto& display : color->displays())
            for (const auto& view : color->views(display)) expect_twins(test_image(), {display, view}, numbers);
        for (const auto& look : color->looks()) expect_twins(test_image(), {"", "", look}, numbers);
    }
}

TEST_F(DisplayPassTest, UnprocessedBackgroundMatchesFiles) {
    expect_twins(test_image(), {},
                 {.exposure_ev = 2, .gamma = 0.8f, .white_balance = white_balance({1, 0.4f, 0.1f}), .background_as_it_is = true});
}

TEST_F(DisplayPassTest, FalseColoursMatchFiles) {
    const std::vector<float> image = test_image();
    for (const auto of : {FalseColorScale::Of::scene, FalseColorScale::Of::exposed}) {
        const DisplayParameters numbers{
            .exposure_ev = 1.3f, .white_balance = white_balance({0.6f, 0.8f, 1}), .false_color = {of, -7.1f, 4.9f}};
        const std::vector<float> card = drawn(image, {}, numbers), processor = computed(image, {}, numbers);
        int compared = 0;
        for (size_t i = 0; i < card.size() / 3; ++i) {
            const Vec3 scene{image[4 * i], image[4 * i + 1], image[4 * i + 2]};
            const float y =
                luminance(of == FalseColorScale::Of::scene ? scene : transform_vector(numbers.white_balance, scene) * std::exp2(1.3f));
            const float at = (std::log2(y) + 7.1f) / 12 * false_color_bands;
            if (std::abs(at - std::round(at)) < 1e-3f) continue; // rounding of the logarithm may differ at a band edge
            ++compared;
            for (size_t k = 0; k < 3; ++k) ASSERT_NEAR(card[3 * i + k], processor[3 * i + k], 0.5 / 255 + 1e-6) << y;
        }
        EXPECT_GT(compared, width * height * 9 / 10);
    }
}

TEST_F(DisplayPassTest, AnEnlargedDenoisedImageIsDrawnAtItsSize) {
    DisplayPass pass;
    const auto shader = color->display_shader({});
    ASSERT_TRUE(shader && pass.set_shader(*shader));
    const auto red_of = [&](int x, int y, int w) {
        std::vector<unsigned char> bytes(size_t(w) * size_t(w) * 4);
        glBindTexture(GL_TEXTURE_2D, pass.texture());
        glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
        return int(bytes[size_t(4 * (y * w + x))]);
    };
    const auto width_drawn = [&](const ImageMix& mix) {
        pass.begin({{}, mix});
        while (pass.busy()) pass.advance(1000);
        GLint w = 0;
        glBindTexture(GL_TEXTURE_2D, pass.texture());
        glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &w);
        return int(w);
    };
    // A bright pixel in the lower right corner of each.
    std::vector<float> coarse(4 * 2 * 2, 0.f), fine(3 * 8 * 8, 0.f);
    coarse[4 * 3] = 1;
    fine[3 * 63] = 1;
    pass.upload(2, 2, coarse);
    pass.upload_denoised(8, 8, std::make_shared<const std::vector<float>>(fine));
    EXPECT_EQ(width_drawn({1, 0}), 2);
    EXPECT_EQ(width_drawn({0, 1}), 8);
    EXPECT_GT(red_of(7, 7, 8), 100);
    EXPECT_LT(red_of(6, 7, 8), 10);
    EXPECT_LT(red_of(4, 4, 8), 10);
    EXPECT_EQ(width_drawn({0.5f, 0.5f}), 8);
    EXPECT_GT(red_of(4, 4, 8), 100) << "the raw image is as coarse as before";
    EXPECT_LT(red_of(3, 4, 8), 10);
}

} // namespace
} // namespace blush::TEST_FILE
