#include "app/commands/render/render_loop.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

#include <set>

namespace blush::TEST_FILE {
namespace {

constexpr int64_t plenty = 1'000'000;

TEST(NextBatch, GrowsToAQuarterOfASecond) {
    EXPECT_EQ(next_batch(0, 0, plenty), 1);
    EXPECT_EQ(next_batch(1, 0.001, plenty), 2);
    EXPECT_EQ(next_batch(64, 0.01, plenty), 128);
    EXPECT_EQ(next_batch(64, 0.25, plenty), 64);
    EXPECT_EQ(next_batch(64, 2.5, plenty), 6);
    EXPECT_EQ(next_batch(1, 30, plenty), 1);
    EXPECT_EQ(next_batch(64, 0, plenty), 128);
}

TEST(NextBatch, EndsAtTheLastSample) {
    EXPECT_EQ(next_batch(64, 0.01, 5), 5);
    EXPECT_EQ(next_batch(0, 0, 1), 1);
}

TEST(StopProgress, TheNearestRuleCounts) {
    RenderSettings settings;
    settings.spp = 100;
    EXPECT_DOUBLE_EQ(stop_progress(settings, 25, 1000, {}), 0.25);
    settings.seconds = 10;
    EXPECT_DOUBLE_EQ(stop_progress(settings, 25, 9, {}), 0.9);
    settings.error = 0.01;
    EXPECT_DOUBLE_EQ(stop_progress(settings, 25, 1, {true, 0.1, 0.05, 0.15}), 0.25);
    EXPECT_DOUBLE_EQ(stop_progress(settings, 25, 1, {true, 0.02, 0.01, 0.03}), 0.5);
    EXPECT_EQ(stop_progress(settings, 25, 1, {true, 0.01, 0, 0.02}), 1);
    EXPECT_DOUBLE_EQ(stop_progress(settings, 25, 1, {false, 0, 0, 0}), 0.25) << "an unknown error does not stop the render";
    EXPECT_EQ(stop_progress(settings, 100, 1, {}), 1);
}

TEST(StopProgress, CountsFromTheFirstSample) {
    RenderSettings settings;
    settings.first_sample = 100;
    settings.spp = 200;
    EXPECT_DOUBLE_EQ(stop_progress(settings, 50, 0, {}), 0.5);
}

RenderSettings tiny(int64_t spp) {
    RenderSettings settings;
    settings.width = 16;
    settings.height = 12;
    settings.spp = spp;
    return settings;
}

TEST(RenderLoop, RendersAsManySamplesAsAskedFor) {
    const std::atomic<bool> no{false};
    Renderer renderer;
    const RenderSettings settings = tiny(37);
    renderer.update(test::sample_project().project.scene, settings);
    double last = 0;
    const LoopResult result = run_render_loop(renderer, settings, no, [&](const LoopProgress& p) {
        EXPECT_GT(p.fraction, last);
        last = p.fraction;
    });
    EXPECT_EQ(last, 1);
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(result.samples, 37);
    EXPECT_EQ(result.frame.samples, 37);
    EXPECT_EQ(result.frame.rgba.size(), size_t(16 * 12 * 4));
}

TEST(RenderLoop, ImageDoesNotDependOnBatches) {
    const std::atomic<bool> no{false};
    const RenderSettings settings = tiny(16);
    const Scene scene = test::sample_project().project.scene;
    Renderer in_batches, at_once;
    in_batches.update(scene, settings);
    const LoopResult result = run_render_loop(in_batches, settings, no, [](const LoopProgress&) {});
    at_once.update(scene, settings);
    at_once.render(0, 16);
    EXPECT_EQ(result.frame.rgba, at_once.resolve().rgba);
}

TEST(RenderLoop, AnInterruptKeepsThePartialImage) {
    std::atomic<bool> interrupted{false};
    Renderer renderer;
    const RenderSettings settings = tiny(plenty);
    renderer.update(test::sample_project().project.scene, settings);
    const LoopResult result = run_render_loop(renderer, settings, interrupted, [&](const LoopProgress& p) {
        if (p.samples >= 3) interrupted = true;
    });
    EXPECT_FALSE(result.complete);
    EXPECT_GE(result.samples, 3);
    EXPECT_EQ(result.frame.samples, result.samples);
}

TEST(RenderLoop, AnErrorLimitStopsIt) {
    const std::atomic<bool> no{false};
    Renderer renderer;
    RenderSettings settings = tiny(0);
    settings.error = 0.05;
    renderer.update(test::sample_project().project.scene, settings);
    const LoopResult result = run_render_loop(renderer, settings, no, [](const LoopProgress&) {});
    EXPECT_TRUE(result.complete);
    EXPECT_TRUE(result.frame.error.known);
    EXPECT_LE(result.frame.error.relmse, settings.error);
}

// Otherwise the image of an error limit would depend on the speed of the machine.
TEST(RenderLoop, ChecksTheErrorAtFixedSampleCounts) {
    const std::atomic<bool> no{false};
    Renderer renderer;
    RenderSettings settings = tiny(40);
    settings.error = 1e-9;
    renderer.update(test::sample_project().project.scene, settings);
    std::set<int64_t> halts;
    run_render_loop(renderer, settings, no, [&](const LoopProgress& p) { halts.insert(p.samples); });
    for (int64_t next = next_error_look(0); next < 40; next = next_error_look(next)) EXPECT_TRUE(halts.contains(next)) << next;
}

} // namespace
} // namespace blush::TEST_FILE
