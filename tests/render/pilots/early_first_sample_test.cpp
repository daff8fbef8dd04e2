// A first sample that is shown as soon as learned sampling has decided: without smooth edges, with a part of its light paths.
#include "tests/render/pilots/pilot_checks.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

namespace blush::test::TEST_FILE {
namespace {

// Beside the ball a lamp in view, whose edges are smooth.
Scene ball_in_the_sun(bool with_lamp) {
    Scene scene = glass_ball_in_sun();
    if (!with_lamp) return scene;
    Light lamp;
    lamp.kind = Light::Kind::point;
    lamp.radius = 0.1f;
    lamp.intensity = 0.1f;
    place_light(scene, lamp, at({0.8f, 0.6f, 1}));
    return scene;
}

RenderSettings smooth(int width, int height, int64_t spp) {
    RenderSettings settings = settings_for(width, height, spp);
    settings.caustics = CausticStrategy::automatic;
    settings.smooth_edges = true;
    return settings;
}
// Each pass has several tiles of light paths, even in these small images.
RendererOptions with_many_light_paths() {
    return {.threads = 2, .planes = {}, .caustics = {.light_path_share = 16, .manifold_sampling = false}};
}

void begin_early(Renderer& renderer, const RenderSettings& settings, bool with_lamp = true) {
    renderer.update(ball_in_the_sun(with_lamp), settings);
    ASSERT_TRUE(renderer.decide_first_sample());
    ASSERT_TRUE(renderer.render(0, 1));
}
std::unique_ptr<Renderer> fresh(const RenderSettings& settings, int64_t count, bool with_lamp = true) {
    auto renderer = std::make_unique<Renderer>(with_many_light_paths());
    renderer->update(ball_in_the_sun(with_lamp), settings);
    EXPECT_TRUE(renderer->render(0, count));
    return renderer;
}

TEST(EarlyFirstSample, IsCompletedWithTheSecond) {
    for (const bool adaptive : {false, true}) {
        RenderSettings settings = smooth(80, 48, 24);
        settings.adaptive = adaptive;
        const std::unique_ptr<Renderer> whole = fresh(settings, 24);
        ASSERT_TRUE(feature_line(*whole, "smooth edges").used);
        ASSERT_TRUE(feature_line(*whole, "light paths").used);
        Renderer renderer(with_many_light_paths());
        begin_early(renderer, settings);
        EXPECT_EQ(feature_line(renderer, "smooth edges").why, "a pilot finds the pixels after the first sample");
        if (adaptive) { ASSERT_TRUE(renderer.add_light_paths()); }
        EXPECT_TRUE(renderer.lacks_light_paths());
        ASSERT_TRUE(renderer.render(1, 1));
        EXPECT_FALSE(renderer.lacks_light_paths());
        ASSERT_TRUE(renderer.render(2, 22));
        const Frame image = renderer.resolve(), expected = whole->resolve();
        EXPECT_TRUE(same_pixels(image, expected));
        EXPECT_EQ(image.rays.camera, expected.rays.camera);
        EXPECT_EQ(image.rays.bounce, expected.rays.bounce);
    }
}

// What is saved does not depend on how soon the sample was shown.
TEST(EarlyFirstSample, IsCompletedBeforeItIsSaved) {
    const RenderSettings settings = smooth(80, 48, 4);
    Renderer renderer(with_many_light_paths()), continued(with_many_light_paths());
    begin_early(renderer, settings);
    EXPECT_FALSE(renderer.save_film(0));
    const Frame shown = renderer.resolve();
    ASSERT_TRUE(renderer.settle_first_sample());
    EXPECT_FALSE(same_pixels(renderer.resolve(), shown));
    const Result<FilmState> film = renderer.save_film(0);
    ASSERT_TRUE(film) << film.error().text();
    continued.update(ball_in_the_sun(true), settings);
    ASSERT_TRUE(continued.load_film(*film) && continued.render(1, 3));
    EXPECT_TRUE(same_pixels(continued.resolve(), fresh(settings, 4)->resolve()));
}

// Stopped while it is completed, it stays as it was shown.
TEST(EarlyFirstSample, StaysWhenItsCompletionIsStopped) {
    const RenderSettings settings = smooth(80, 48, 4);
    Renderer renderer(with_many_light_paths());
    begin_early(renderer, settings);
    ASSERT_TRUE(renderer.decide());
    const Frame shown = renderer.resolve();
    EXPECT_FALSE(renderer.render(1, 1, [] { return false; }));
    EXPECT_TRUE(same_pixels(renderer.resolve(), shown));
    ASSERT_TRUE(renderer.render(1, 3));
    EXPECT_TRUE(same_pixels(renderer.resolve(), fresh(settings, 4)->resolve()));
}

// Stopped while it gets smooth edges, it can be shown, but not be saved.
TEST(EarlyFirstSample, IsNotSavedWhenItsSmoothEdgesAreStopped) {
    const RenderSettings settings = smooth(80, 48, 4);
    Renderer renderer(with_many_light_paths());
    begin_early(renderer, settings);
    while (renderer.lacks_light_paths()) ASSERT_TRUE(renderer.add_light_paths());
    ASSERT_TRUE(renderer.decide());
    EXPECT_FALSE(renderer.render(1, 1, [] { return false; }));
    EXPECT_FALSE(renderer.save_film(0));
}

// Light selection that follows the mix forgets what the pilots had decided.
TEST(EarlyFirstSample, IsRenderedAgainWhenLightSelectionFollowsTheMix) {
    const RenderSettings settings = smooth(80, 48, 4);
    Scene scene = ball_in_the_sun(true);
    scene.mix.grouping = LightMix::Grouping::by_light;
    Renderer renderer(with_many_light_paths()), whole(with_many_light_paths());
    renderer.update(scene, settings);
    ASSERT_TRUE(renderer.decide_first_sample() && renderer.render(0, 1));
    ASSERT_TRUE(renderer.lacks_light_paths());
    whole.update(scene, settings);
    for (Renderer* r : {&renderer, &whole}) r->select_lights_by_mix();
    EXPECT_FALSE(renderer.lacks_light_paths());
    ASSERT_TRUE(renderer.render(1, 3) && whole.render(0, 4));
    EXPECT_TRUE(same_pixels(renderer.resolve(), whole.resolve()));
}

// An image so small that a pass has no light path.
TEST(EarlyFirstSample, MayLackLightPathsForGood) {
    const RenderSettings settings = smooth(2, 2, 4);
    RendererOptions options = with_many_light_paths();
    options.caustics.light_path_share = 0.125f;
    Renderer renderer(options), whole(options);
    for (Renderer* r : {&renderer, &whole}) r->update(ball_in_the_sun(true), settings);
    ASSERT_TRUE(renderer.decide_first_sample() && renderer.render(0, 1));
    EXPECT_FALSE(renderer.lacks_light_paths());
    ASSERT_TRUE(renderer.render(1, 3) && whole.render(0, 4));
    EXPECT_TRUE(same_pixels(renderer.resolve(), whole.resolve()));
}

// Of light paths. Longer paths and highlights without smooth edges differ too much for a test of means.
TEST(EarlyFirstSample, HasTheSameMean) {
    RenderSettings settings = smooth(32, 24, 1);
    settings.max_bounces = 3;
    settings.smooth_edges = false;
    BlockMoments early, whole;
    for (uint32_t seed = 0; seed < 32; ++seed) {
        settings.seed = seed;
        Renderer renderer(with_many_light_paths());
        begin_early(renderer, settings, false);
        early.add(image_of(renderer).blocks(8, 8));
        ASSERT_TRUE(renderer.settle_first_sample());
        settings.seed = 1000 + seed;
        whole.add(image_of(*fresh(settings, 2, false)).blocks(8, 8));
    }
    EXPECT_TRUE(same_means(early.measured(), whole.measured()));
}

} // namespace
} // namespace blush::test::TEST_FILE
