// The pilot of light paths: what it knows of their work, and which noise it leaves out.
#include "render/pilots/light_path_pilot.h"

#include "render/film/edges/edge_pixels.h"
#include "render/pilots/variant_comparison.h"
#include "tests/render/pilots/pilot_checks.h"
#include "tests/render/scenes.h"
#include "tests/support/statistics.h"

#include <cmath>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

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

// A scene that is compiled for the pilot.
class Measured {
public:
    Measured(const Scene& scene, const RenderSettings& settings) {
        compiled_.update(expand_area_lights(scene), settings, full_plan(), Workers(2));
        context_ = {&compiled_.tables(), &compiled_.accel(), kernel_settings(settings, settings.width, settings.height)};
    }
    const Kernel& kernel(bool light_paths) const {
        const Features features = compiled_.features();
        return choose_kernel(light_paths ? features.with(Feature::light_paths) : features);
    }
    std::optional<LightPathPilot> pilot(const std::optional<RefinedEmission>& refined) const {
        std::vector<std::unique_ptr<TileScratch>> scratch(2);
        return measure_light_paths(context_, compiled_.bounding_sphere(), kernel(true), refined, Workers(2), scratch, {});
    }

private:
    RenderScene compiled_;
    KernelContext context_{};
};

// The rays that it counts for a light path are those that twice as many light paths add to an image.
TEST(LightPathPilot, CountsTheRaysOfImages) {
    const Scene scene = shipped_scene("metal-ring");
    RenderSettings settings;
    settings.width = settings.height = 256; // one light path for each of its pixels: as many as the pilot traces
    settings.caustics = CausticStrategy::light_paths;
    settings.max_bounces = pilot_max_bounces;
    const std::vector<double> once = work_of_samples(scene, settings, 1), twice = work_of_samples(scene, settings, 2);
    statistics::Moments added;
    for (size_t k = 0; k < once.size(); ++k) added.add(twice[k] - once[k]);

    const auto pilot = Measured(scene, settings).pilot({});
    ASSERT_TRUE(pilot);
    EXPECT_GT(pilot->work, 1);
    const double error = std::sqrt(added.variance() * (1 + 1 / double(added.count)));
    EXPECT_TRUE(statistics::z_verdict("rays differ", pilot->work - added.mean, error, added.mean, statistics::significance));
}

// What the camera sees of the lamp in the metal ring has most of the noise in a pilot, and light paths cannot take it away. Smooth edges
// do, so it must not hide what light paths gain.
TEST(LightPathPilot, LeavesNoiseOfVisibleLampsToSmoothEdges) {
    RenderSettings settings;
    settings.width = 320;
    settings.height = 180;
    const Measured ring(shipped_scene("metal-ring"), settings);
    const auto all = ring.pilot({}), refined = ring.pilot(RefinedEmission{ring.kernel(false), longest_highlight_chain});
    ASSERT_TRUE(all && refined && all->figures && refined->figures);
    EXPECT_LT(refined->figures->mse, 0.5 * all->figures->mse);
    EXPECT_EQ(refined->work, all->work);
}

} // namespace
} // namespace blush::test::TEST_FILE
