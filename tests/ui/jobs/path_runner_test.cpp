// The thread of the path tool: the first path at once, all of them in the end, and their mean the film's.
#include "ui/jobs/path_runner.h"

#include "core/math.h"
#include "io/gltf/read/import.h"
#include "render/renderer.h"
#include "tests/support/eventually.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

using test::eventually;

Scene shipped(const std::string& name) { return import_gltf(BLUSH_ASSETS "/scenes/" + name + ".gltf")->scene; }

PathWork::Input input_of(const std::string& scene, std::vector<TracedPixel> pixels, int64_t samples) {
    PathWork::Input input{shipped(scene), recommended_settings(), std::move(pixels), samples};
    input.settings.width = 48;
    input.settings.height = 30;
    input.settings.adaptive = false;
    input.settings.reuse = 1;
    input.settings.smooth_edges = false;
    return input;
}

TEST(PathRunner, MeanIsTheFilms) {
    // Without and with pilots that render the first sample again.
    for (const char* scene : {"cornell", "metal-ring"}) {
        PathWork::Input input = input_of(scene, {{20, 18}}, 40);
        input.settings.caustics = CausticStrategy::guiding; // light paths are not replayed
        PathRunner runner;
        runner.measure(input);
        ASSERT_TRUE(eventually([&] { return runner.state().rests; }));
        const PathWork::Output set = runner.state().output;
        ASSERT_EQ(set->paths.size(), 40u);
        Renderer renderer;
        renderer.update(input.scene, input.settings);
        renderer.render(0, 40);
        const Frame frame = renderer.resolve();
        const float* film = &frame.rgba[4 * (18 * 48 + 20)];
        EXPECT_NEAR(set->sum.mean.x, film[0], 2e-6 * film[0]) << scene;
        EXPECT_NEAR(set->sum.mean.z, film[2], 2e-6 * film[2] + 1e-9) << scene;
        EXPECT_NEAR(set->means.back().mean, luminance(Vec3{film[0], film[1], film[2]}), 1e-5) << scene;
        EXPECT_EQ(set->means.back().samples, 40);
        EXPECT_TRUE(set->left_out.empty()) << scene;
    }
}

TEST(PathRunner, TracesSampleBySample) {
    PathRunner runner;
    runner.measure(input_of("cornell", {{3, 4}, {30, 20}}, 3));
    ASSERT_TRUE(eventually([&] { return runner.state().rests; }));
    const PathWork::Output set = runner.state().output;
    ASSERT_EQ(set->paths.size(), 6u);
    for (size_t k = 0; k < 6; ++k) {
        EXPECT_EQ(set->paths[k]->sample, int64_t(k / 2));
        EXPECT_EQ(set->paths[k]->x, k % 2 ? 30 : 3);
    }
}

TEST(PathRunner, OnlyPreparesWithoutPixels) {
    PathRunner runner;
    runner.measure(input_of("cornell", {}, 100));
    ASSERT_TRUE(eventually([&] { return runner.state().rests; }));
    EXPECT_TRUE(runner.state().output->paths.empty());
}

// Pilots that would take long do not delay the first path, and neither does the work for the input before.
TEST(PathRunner, ShowsTheFirstPathBeforeThePilots) {
    PathRunner runner;
    PathWork::Input input = input_of("pool", {}, 1);
    input.settings.width = 1280;
    input.settings.height = 720;
    runner.measure(input);
    input.pixels = {{640, 500}};
    input.samples = 4;
    runner.measure(input);
    ASSERT_TRUE(eventually([&] { return runner.state().output != nullptr; }));
    const PathWork::Output first = runner.state().output;
    EXPECT_EQ(first->paths.size(), 1u);
    EXPECT_FALSE(first->complete);
}

TEST(PathRunner, SaysThatLightPathsAreNotReplayed) {
    PathRunner runner;
    PathWork::Input input = input_of("metal-ring", {{20, 18}}, 2);
    input.settings.caustics = CausticStrategy::light_paths;
    runner.measure(input);
    ASSERT_TRUE(eventually([&] { return runner.state().rests; }));
    ASSERT_EQ(runner.state().output->left_out.size(), 1u);
    EXPECT_TRUE(runner.state().output->left_out[0].starts_with("light paths"));
}

} // namespace
} // namespace blush::TEST_FILE
