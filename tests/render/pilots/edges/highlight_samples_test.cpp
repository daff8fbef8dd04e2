// Which pixels take more samples of the emission, by what they gain for their rays.
#include "render/pilots/edges/highlight_samples.h"

#include <gtest/gtest.h>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

constexpr double image_pixels = 1000;

// A highlight whose samples trace half a ray each. All its light is that of the lamp, so paths have the variance of the emission.
MeasuredPixel highlight(double variance) {
    MeasuredPixel pixel;
    pixel.measured = 128;
    pixel.rays = 64;
    pixel.variance = pixel.path_variance = variance;
    return pixel;
}

// Of an image of which a pixel of this variance has that share, whose camera paths trace one ray.
ImageNoise noise_of(double variance, double share, double light_path_work) {
    const double mse = variance / image_pixels / share;
    return {.mse = mse, .relmse = mse / dark_squared, .work = 1 + light_path_work, .light_path_work = light_path_work};
}

// For 3 % of the noise, 3.25 % more rays do not pay.
TEST(HighlightSamples, PayMoreWhereLightPathsTakeTimeToo) {
    for (const double light_path_work : {0., 1., 10.}) {
        std::vector<MeasuredPixel> measured{highlight(1)};
        std::vector<FaintCell> cells;
        choose_highlight_samples(measured, cells, image_pixels, noise_of(1, 0.03, light_path_work));
        EXPECT_EQ(measured[0].samples, light_path_work > 0 ? highlight_samples : 0) << light_path_work;
    }
}

TEST(HighlightSamples, AddAtMostHalfOfTheRaysOfCameraPaths) {
    for (const double light_path_work : {0., 10.}) {
        std::vector<MeasuredPixel> measured(20, highlight(1));
        std::vector<FaintCell> cells;
        choose_highlight_samples(measured, cells, image_pixels, noise_of(1, 0.05, light_path_work));
        double rays = 0;
        for (const MeasuredPixel& pixel : measured)
            if (pixel.samples > 0) rays += (pixel.samples + 1) * pixel.rays_per_sample() / image_pixels;
        EXPECT_LE(rays, 0.5) << light_path_work;
        EXPECT_GT(rays, 0.4) << light_path_work; // all pixels would be worth them
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
