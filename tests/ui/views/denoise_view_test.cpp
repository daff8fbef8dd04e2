// View modes of raw and denoised images.
#include "ui/views/denoise_view.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

using Show = DenoiseView::Show;

Frame frame_of(int width, int height) {
    Frame frame;
    frame.width = width;
    frame.height = height;
    for (int i = 0; i < width * height; ++i)
        for (const float v : {float(i), 2 * float(i), 3 * float(i), 1.f}) frame.rgba.push_back(v);
    return frame;
}

DenoisedImage denoised_of(int width, int height, float value) {
    DenoisedImage image;
    image.width = width;
    image.height = height;
    for (int i = 0; i < 3 * width * height; ++i) image.denoised.rgb.push_back(value + float(i / 3));
    return image;
}

TEST(DenoiseView, ToggleSwitchesBetweenRawAndDenoised) {
    DenoiseView view;
    EXPECT_FALSE(view.wants_denoised());
    view.toggle();
    EXPECT_EQ(view.show, Show::denoised);
    view.show = Show::difference;
    view.toggle();
    EXPECT_EQ(view.show, Show::raw);
}

TEST(DenoiseView, EachModeHasItsWeights) {
    const Frame frame = frame_of(3, 2);
    const DenoisedImage denoised = denoised_of(3, 2, 10);
    const auto middle = [&](Show show) { return mixed_pixel(frame, &denoised, mix_of({show, 0.25f}, true), 1, 1); };
    EXPECT_EQ(middle(Show::raw), (Vec3{4, 8, 12}));
    EXPECT_EQ(middle(Show::denoised), (Vec3{14, 14, 14}));
    EXPECT_EQ(middle(Show::blend), (Vec3{6.5f, 9.5f, 12.5f})) << "a quarter of the way";
    EXPECT_EQ(middle(Show::difference), (Vec3{10, 6, 2})) << "its size, whichever is brighter";
}

TEST(DenoiseView, WithoutADenoisedImageTheRawOneIsShown) {
    const Frame frame = frame_of(2, 1);
    for (const Show show : {Show::raw, Show::denoised, Show::blend, Show::difference}) {
        const ImageMix mix = mix_of({show, 0.5f}, false);
        EXPECT_EQ(mix, ImageMix{});
        EXPECT_EQ(mixed_image(frame, nullptr, mix), (std::vector<float>{0, 0, 0, 1, 2, 3}));
    }
}

TEST(DenoiseView, CoarserDenoisedImageIsUpscaled) {
    const Frame frame = frame_of(5, 4);
    const DenoisedImage coarse = denoised_of(2, 2, 0);
    EXPECT_EQ(denoised_pixel(frame, coarse, 0, 0).x, 0);
    EXPECT_EQ(denoised_pixel(frame, coarse, 4, 0).x, 1);
    EXPECT_EQ(denoised_pixel(frame, coarse, 0, 3).x, 2);
    EXPECT_EQ(denoised_pixel(frame, coarse, 4, 3).x, 3);
    const Frame tiny = frame_of(1, 1);
    EXPECT_EQ(denoised_pixel(tiny, coarse, 0, 0).x, 3) << "the pixel under its middle";
    EXPECT_EQ(mixed_image(frame, &coarse, mix_of({Show::denoised, 0}, true)).size(), 5u * 4 * 3);
}

TEST(DenoiseView, TextNamesTheImageAndItsDelay) {
    Frame frame = frame_of(4, 4);
    frame.samples = 48;
    frame.seconds = 7.5;
    DenoisedImage denoised = denoised_of(4, 4, 0);
    denoised.samples = 16;
    denoised.rendered_seconds = 6;
    denoised.quality = DenoiseQuality::high;
    EXPECT_EQ(shown_text({Show::raw, 0}, frame, &denoised), "raw");
    EXPECT_EQ(shown_text({Show::denoised, 0}, frame, nullptr), "raw, denoising");
    EXPECT_EQ(shown_text({Show::denoised, 0}, frame, &denoised), "denoised, 32 spp and 1.5 s behind");
    EXPECT_EQ(shown_text({Show::blend, 0.4f}, frame, &denoised), "blend 40 %, 32 spp and 1.5 s behind");
    denoised.quality = DenoiseQuality::fast;
    EXPECT_EQ(shown_text({Show::denoised, 0}, frame, &denoised), "denoised, fast quality, 32 spp and 1.5 s behind");
    denoised.samples = 48;
    EXPECT_EQ(shown_text({Show::denoised, 0}, frame, &denoised), "denoised, fast quality");
    denoised.quality = DenoiseQuality::base;
    EXPECT_EQ(shown_text({Show::denoised, 0}, frame, &denoised), "denoised, base quality");
    denoised.quality = DenoiseQuality::high;
    EXPECT_EQ(shown_text({Show::difference, 0}, frame, &denoised), "difference");
    denoised.divider = 4;
    EXPECT_EQ(shown_text({Show::denoised, 0}, frame, &denoised), "denoised of 1/4 size");
    denoised.is_enlarged = true;
    EXPECT_EQ(shown_text({Show::denoised, 0}, frame, &denoised), "denoised of 1/4 size, edges sharpened");
    denoised.with_history = {1, 1, {1, 2, 3}, 0.6f};
    EXPECT_EQ(shown_text({Show::denoised, 0}, frame, &denoised), "denoised of 1/4 size, edges sharpened, 60 % of the view before");
    // Tools measure what is saved.
    EXPECT_EQ(denoised_pixel(frame, denoised, 0, 0).x, denoised.denoised.rgb[0]);
}

} // namespace
} // namespace blush::TEST_FILE
