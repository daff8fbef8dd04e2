// Newton's method for highlights: the images of lamps in a plane mirror, in closed form; less noise in curved glass; the same places on any
// number of threads.
#include "render/pilots/edges/highlight_location.h"

#include "render/film/edges/edge_samples.h"
#include "tests/render/integrator/manifold/lit_casters.h"
#include "tests/render/pilots/pilot_checks.h"
#include "tests/render/scenes.h"
#include "tests/support/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

using statistics::Moments;

constexpr int width = 64, height = 48;
constexpr double yfov = 1;

struct Located {
    RenderScene scene;
    KernelContext context;
    SceneTables tables;
    Workers workers;
    std::vector<std::unique_ptr<TileScratch>> scratch;
    HighlightsLocated found;
    size_t sightings = 0;

    explicit Located(const Scene& s, unsigned threads = 2) : workers(threads), scratch(threads) {
        const RenderSettings settings = settings_for(width, height, 16);
        scene.update(expand_area_lights(s), settings, full_plan(), workers);
        context = {&scene.tables(), &scene.accel(), kernel_settings(settings, width, height)};
        const auto seen = find_small_highlights(context, kernel(), workers, scratch, {}).value();
        restrict_to_emission(context, tables, longest_highlight_chain);
        const std::vector<Sighting> nearest = small_highlights(seen, 1e9, width * height);
        sightings = nearest.size();
        found = locate_highlights(context, kernel(), nearest, seen.spacing, workers, scratch, {}).value();
    }
    const Kernel& kernel() const { return choose_kernel(scene.features()); }
    bool covers(double x, double y) const {
        return std::ranges::any_of(found.places, [&](const HighlightPlace& p) { return p.contains(x, y); });
    }
};

// Where the camera of looking() at (0, 0, 2) sees a point: along -z, its right is y and its up -x.
std::array<double, 2> projected(const Vec3d& p) {
    const double scale = height / (2 * std::tan(yfov / 2)) / (2 - p.z);
    return {width / 2.0 + p.y * scale, height / 2.0 + p.x * scale};
}

Scene with_a_mirror() {
    Scene scene;
    place(scene, quad({-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}), metal(0));
    scene.view = looking({0, 0, 2}, {0, 0, 0}, float(yfov));
    return scene;
}

TEST(HighlightLocation, FindsTheImageOfABallInAPlaneMirror) {
    Scene scene = with_a_mirror();
    const Vec3d lamp{0.31, -0.22, 1.2};
    constexpr double radius = 0.01;
    place_sphere_light(scene, {float(lamp.x), float(lamp.y), float(lamp.z)}, float(radius), 10);
    const Located located(scene);
    ASSERT_FALSE(located.found.places.empty());
    EXPECT_EQ(located.found.by_sighting.size(), located.sightings);
    // Its mirror image is a ball again, which is seen from far away.
    const Vec3d image{lamp.x, lamp.y, -lamp.z};
    for (int k = 0; k < 100; ++k) {
        const double angle = 2 * std::numbers::pi * k / 100;
        for (const double r : {0.0, 0.5, 0.99}) {
            const auto [x, y] = projected(image + Vec3d{std::cos(angle), std::sin(angle), 0} * (radius * r));
            EXPECT_TRUE(located.covers(x, y)) << angle << ", " << r;
        }
        // The corners of the square around it are sqrt(2) radii away, times the margin of a place.
        const auto [x, y] = projected(image + Vec3d{std::cos(angle), std::sin(angle), 0} * (radius * 2));
        EXPECT_FALSE(located.covers(x, y)) << angle;
    }
}

TEST(HighlightLocation, FindsTheImageOfARectangle) {
    Scene scene = with_a_mirror();
    const float low = 0.5f, high = 0.52f, h = 0.004f;
    place(scene, quad({low, -h, 1}, {low, h, 1}, {high, h, 1}, {high, -h, 1}), emitter(1000));
    const Located located(scene);
    ASSERT_FALSE(located.found.places.empty());
    for (int j = 0; j <= 8; ++j)
        for (int i = 0; i <= 8; ++i) {
            const double across = double(high - low) * (i / 4.0 - 1) / 2, up = double(h) * (j / 4.0 - 1);
            const auto at = [&](double scale) { return projected({double(low + high) / 2 + across * scale, up * scale, -1}); };
            const auto [x, y] = at(0.99);
            EXPECT_TRUE(located.covers(x, y)) << i << ", " << j;
            if (i % 8 != 0 && j % 8 != 0) continue;
            const auto [far_x, far_y] = at(1.6); // a margin of 1.25, and of cells of a third
            EXPECT_FALSE(located.covers(far_x, far_y)) << i << ", " << j;
        }
}

// A lamp of each kind.
Scene lamps_and_glass() {
    Scene scene;
    place(scene, round_sphere(), glass(0, 1.5f));
    place(scene, round_sphere(), metal(0), at({1.6f, 0, -0.5f}, 0.6f));
    place(scene, floor_quad(4, -1), lambert(0.5f));
    place_sphere_light(scene, {-1, 3, 2}, 0.02f, 60);
    place(scene, quad({1.5f, 3, 2}, {1.53f, 3, 2}, {1.53f, 3, 2.03f}, {1.5f, 3, 2.03f}), emitter(9000));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 3;
    sun.angle_radians = 0.01f;
    place_light(scene, sun, aimed({0, 0, 0}, {0.5f, -1, -0.3f}));
    scene.view = looking({0, 0.5f, 4}, {0, 0, 0}, 0.7f);
    return scene;
}

// Reflections on and within a ball, from one lobe to many.
TEST(HighlightLocation, SamplesThatAimHaveTheSameMeanAndAHundredthOfTheNoise) {
    Located located(lamps_and_glass());
    ASSERT_FALSE(located.found.places.empty());
    const HighlightPlaces places(located.found.places, width, height, *located.context.settings.filter);
    std::vector<TileJob> pixels;
    places.for_each_pixel([&](int x, int y, double) { pixels.push_back({.x = x, .y = y, .width = 1, .height = 1, .samples = 512}); });
    Moments plain, aimed;
    double plain_variance = 0, aimed_variance = 0; // of few samples, which may miss a highlight that does not aim: then too small
    located.workers.run([&] {
        TileScratch& tile = *located.scratch[0];
        for (const TileJob& job : pixels)
            for (const bool aims : {false, true}) {
                tile.chains->places = aims ? &places : nullptr;
                KernelContext context = located.context;
                context.settings.sampler = SamplerType::random;
                context.seed = aims ? 7 : 8;
                located.kernel().trace_chains(context, job, tile);
                Moments of_pixel;
                for (int k = 0; k < job.samples; ++k) of_pixel.add(luminance(Vec3d{tile.r[k], tile.g[k], tile.b[k]}));
                (aims ? aimed_variance : plain_variance) += of_pixel.variance();
                for (int k = 0; k < job.samples; ++k) (aims ? aimed : plain).add(luminance(Vec3d{tile.r[k], tile.g[k], tile.b[k]}));
            }
        tile.chains->places = nullptr;
    });
    EXPECT_TRUE(statistics::same_mean(plain, aimed));
    EXPECT_LT(aimed_variance, plain_variance / 100);
}

TEST(HighlightLocation, IsTheSameOnAnyNumberOfThreads) {
    const Located one(lamps_and_glass(), 1), three(lamps_and_glass(), 3);
    EXPECT_FALSE(one.found.places.empty());
    EXPECT_EQ(one.found.places, three.found.places);
    EXPECT_EQ(one.found.by_sighting, three.found.by_sighting);
}

// The aperture blurs highlights, so that ordinary samples meet them.
TEST(HighlightLocation, FindsNoneThroughAnAperture) {
    Scene scene = lamps_and_glass();
    scene.view.lens.aperture_radius = 0.05f;
    scene.view.lens.focus_distance = 4;
    const Located located(scene);
    EXPECT_GT(located.sightings, 0u);
    EXPECT_TRUE(located.found.places.empty());
    EXPECT_EQ(std::ranges::count(located.found.by_sighting, true), 0);
}

} // namespace
} // namespace blush::test::TEST_FILE
