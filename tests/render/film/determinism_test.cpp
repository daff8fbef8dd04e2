// An image depends on scene, settings and sample range only: not on threads, timing, or how the range was split.
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

namespace blush::test::TEST_FILE {
namespace {

// Renders samples [0, ends[0]), [ends[0], ends[1]), ...
// Pixels, planes and statistics.
void expect_same(const Frame& a, const Frame& b, const char* what) {
    EXPECT_TRUE(same_pixels(a, b)) << what;
    EXPECT_EQ(a.rays.total(), b.rays.total()) << what;
    EXPECT_EQ(a.error.relmse, b.error.relmse) << what;
    EXPECT_EQ(a.error.high, b.error.high) << what;
}

TEST(Determinism, DoesNotDependOnThreadsRunsAndSplits) {
    for (const char* name : {"card-and-mug", "veach-mis"}) {
        const Scene scene = shipped_scene(name);
        const RenderSettings settings = settings_for(80, 45, 8);
        const Frame once = render_in_steps(scene, settings, all_planes(1), {8});
        expect_same(once, render_in_steps(scene, settings, all_planes(1), {8}), "a second run");
        expect_same(once, render_in_steps(scene, settings, all_planes(2), {8}), "two threads");
        expect_same(once, render_in_steps(scene, settings, all_planes(2), {3, 8}), "0:3 + 3:8");
        expect_same(once, render_in_steps(scene, settings, all_planes(1), {1, 2, 4, 8}), "doubling");
    }
}

TEST(Determinism, IndependentNumbersDoNotDependOnThreadsAndSplits) {
    RenderSettings settings = settings_for(80, 45, 8);
    settings.sampler = SamplerType::random;
    const Scene scene = shipped_scene("veach-mis");
    const Frame once = render_in_steps(scene, settings, all_planes(1), {8});
    expect_same(once, render_in_steps(scene, settings, all_planes(2), {3, 8}), "two threads, 0:3 + 3:8");
    expect_same(once, render_in_steps(scene, settings, all_planes(1), {1, 2, 4, 8}), "doubling");
}

// Equal means, and with 64 independent samples clearly more noise than with stratified points.
TEST(Samplers, AgreeInTheMeanAndDifferInNoise) {
    const Scene scene = shipped_scene("cornell");
    RenderSettings settings = settings_for(32, 32, 64);
    const RenderedImage points = render(scene, settings);
    settings.sampler = SamplerType::random;
    settings.seed = 1;
    const RenderedImage numbers = render(scene, settings);
    EXPECT_TRUE(same_means(points.blocks(16, 16), numbers.blocks(16, 16)));
    EXPECT_LT(points.frame.error.rmse_high, numbers.frame.error.rmse_low);
}

TEST(Determinism, SharedPathsDoNotDependOnThreadsAndSplits) {
    for (const int reuse : {4, 16}) {
        RenderSettings settings = settings_for(80, 45, 8);
        settings.reuse = reuse;
        const Scene scene = shipped_scene("cornell");
        const Frame once = render_in_steps(scene, settings, all_planes(1), {8});
        expect_same(once, render_in_steps(scene, settings, all_planes(2), {8}), "two threads");
        expect_same(once, render_in_steps(scene, settings, all_planes(2), {3, 8}), "0:3 + 3:8");
        expect_same(once, render_in_steps(scene, settings, all_planes(1), {1, 2, 4, 8}), "doubling");
    }
}

TEST(Determinism, AlphaAndShadowsOfAlphaDoNotDependOnSplits) {
    Scene scene;
    Material veil = lambert(0.5f);
    veil.alpha = Material::Alpha::blend;
    veil.opacity = 0.4f;
    place(scene, floor_quad(0.5f, 0.5f), veil);
    place(scene, floor_quad(2), lambert(0.7f));
    Light sun;
    sun.kind = Light::Kind::sun;
    place_light(scene, sun, aimed({0, 0, 0}, {0.2f, -1, 0.1f}));
    constant_world(scene, 0.2f);
    scene.view = looking_down(1, 1);
    for (const int reuse : {1, 16}) {
        RenderSettings settings = settings_for(40, 40, 8);
        settings.reuse = reuse;
        const Frame once = render_in_steps(scene, settings, all_planes(1), {8});
        expect_same(once, render_in_steps(scene, settings, all_planes(2), {3, 8}), "0:3 + 3:8");
    }
}

TEST(Determinism, SeedsAreIndependent) {
    const Scene scene = shipped_scene("cornell");
    RenderSettings settings = settings_for(32, 32, 16);
    const RenderedImage a = render(scene, settings);
    settings.seed = 1;
    const RenderedImage b = render(scene, settings);
    // Otherwise their mean would be no better than one of them: the variance of a difference is the sum of both.
    double difference = 0, sum = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        difference += std::pow(a.pixels[i].y - b.pixels[i].y, 2);
        sum += std::pow(a.errors[i].y, 2) + std::pow(b.errors[i].y, 2);
    }
    EXPECT_GT(difference, 0.5 * sum);
    EXPECT_LT(difference, 2 * sum);
}

TEST(Determinism, AStoppedRenderReturnsFalse) {
    Renderer renderer;
    renderer.update(shipped_scene("cornell"), settings_for(64, 64, 4));
    EXPECT_FALSE(renderer.render(0, 4, [] { return false; }));
    for (const float value : renderer.resolve().rgba) EXPECT_TRUE(std::isfinite(value));
}

} // namespace
} // namespace blush::test::TEST_FILE
