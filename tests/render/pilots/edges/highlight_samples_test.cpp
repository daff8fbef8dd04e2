// Which pixels take more samples of the emission, by what they gain for their rays.
#include "render/pilots/edges/highlight_samples.h"

#include "render/pilots/light_path_pilot.h"
#include "tests/render/pilots/pilot_checks.h"
#include "tests/render/scenes.h"
#include "tests/support/statistics.h"

#include <cmath>
#include <gtest/gtest.h>

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

double path_work_of(const RayCounts& rays) { return double(rays.camera + rays.bounce) + shadow_ray_cost * double(rays.shadow); }

// Rays of the samples 2, 3, ... of a pixel, for this share of light paths.
std::vector<double> work_of_samples(const Scene& scene, const RenderSettings& settings, float share) {
    Renderer renderer({.threads = 2, .caustics = {.light_path_share = share}});
    renderer.update(scene, settings);
    EXPECT_TRUE(renderer.render(0, 2));
    double before = path_work_of(renderer.resolve().rays);
    std::vector<double> work;
    for (int64_t sample = 2; sample < 10; ++sample) {
        EXPECT_TRUE(renderer.render(sample, 1));
        const double now = path_work_of(renderer.resolve().rays);
        work.push_back((now - before) / (double(settings.width) * double(settings.height)));
        before = now;
    }
    return work;
}

// The rays that the pilot of light paths counts are those of images: what twice as many light paths add.
TEST(HighlightSamples, KnowTheRaysOfLightPaths) {
    const Scene scene = shipped_scene("metal-ring");
    RenderSettings settings;
    settings.width = settings.height = 256; // one light path for each of its pixels: as many as the pilot traces
    settings.caustics = CausticStrategy::light_paths;
    settings.max_bounces = pilot_max_bounces;
    const std::vector<double> once = work_of_samples(scene, settings, 1), twice = work_of_samples(scene, settings, 2);
    statistics::Moments added;
    for (size_t k = 0; k < once.size(); ++k) added.add(twice[k] - once[k]);

    RenderScene compiled;
    compiled.update(expand_area_lights(scene), settings, full_plan(), Workers(2));
    const KernelContext context{&compiled.tables(), &compiled.accel(), kernel_settings(settings, settings.width, settings.height)};
    const Kernel& kernel = choose_kernel(compiled.features().with(Feature::light_paths));
    std::vector<std::unique_ptr<TileScratch>> scratch(2);
    const auto pilot = measure_light_paths(context, compiled.bounding_sphere(), kernel, Workers(2), scratch, {});
    ASSERT_TRUE(pilot);
    EXPECT_GT(pilot->work, 1);
    const double error = std::sqrt(added.variance() * (1 + 1 / double(added.count)));
    EXPECT_TRUE(statistics::z_verdict("rays differ", pilot->work - added.mean, error, added.mean, statistics::significance));
}

} // namespace
} // namespace blush::test::TEST_FILE
