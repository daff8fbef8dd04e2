// Smooth edges of lamps in mirrors and glass: the same mean with less noise, however the image is rendered; all planes fit; and the error
// is known where highlights would be missed without.
#include "render/film/film_state.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fmt/format.h>

namespace blush::test::TEST_FILE {
namespace {

using statistics::Moments;

RenderSettings smooth(RenderSettings settings) {
    settings.smooth_edges = true;
    return settings;
}

// Without the strategies for caustics, whose pilots take most of the time of images so small.
RenderSettings quick_settings(int width, int height, int64_t spp) {
    RenderSettings settings = settings_for(width, height, spp);
    settings.caustics = CausticStrategy::off;
    return settings;
}

std::string decision(const Frame& frame) {
    const auto found = std::ranges::find(*frame.feature_report, "smooth edges", &FeatureUse::name);
    return found == frame.feature_report->end() ? "" : found->why;
}
bool has_highlights(const Frame& frame) {
    const std::string why = decision(frame);
    return why.find("paths a sample") < why.size() || why.find("path by all lobes a sample") < why.size();
}

// The lamps are behind the camera, their images in the mirror about as large as a pixel of 64 x 48.
Scene lamps_in_a_mirror() {
    Scene scene;
    place(scene, quad({-3, -2, 0}, {3, -2, 0}, {3, 2, 0}, {-3, 2, 0}), metal(0));
    place(scene, floor_quad(4, -0.6f), lambert({0.5f, 0.4f, 0.3f}));
    for (const float x : {-0.93f, -0.2f, 0.31f, 1.14f})
        for (const float y : {0.4f, 0.77f}) place_sphere_light(scene, {x, y, 4}, 0.05f, 10);
    scene.view = looking({0, 0, 3}, {0, 0, 0}, 0.6f);
    return scene;
}

// Over two mirrors. The second one tints.
Scene lamps_in_two_mirrors() {
    Scene scene = lamps_in_a_mirror();
    Material tinted = metal(0);
    tinted.base_color = {0.9f, 0.5f, 0.2f};
    place(scene, quad({1.2f, -2, 0}, {1.2f, -2, 6}, {1.2f, 2, 6}, {1.2f, 2, 0}), tinted);
    return scene;
}

Scene lamp_in_glass() {
    Scene scene;
    place(scene, floor_quad(4, -1), lambert(0.5f));
    place(scene, sphere(false), glass(0, 1.5f));
    place_sphere_light(scene, {1, 3, 2}, 0.3f, 60);
    scene.view = looking({0, 0.5f, 4}, {0, 0, 0}, 0.7f);
    return scene;
}

Scene sun_in_a_mirror_out_of_focus() {
    Scene scene;
    place(scene, quad({-3, -2, 0}, {3, -2, 0}, {3, 2, 0}, {-3, 2, 0}), metal(0));
    place(scene, floor_quad(4, -0.6f), lambert(0.4f));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 3;
    sun.angle_radians = 0.03f;
    place_light(scene, sun, aimed({0, 0, 0}, {0.1f, -0.15f, -1}));
    scene.view = looking({0, 0, 3}, {0, 0, 0}, 0.6f);
    scene.view.lens.aperture_radius = 0.02f;
    scene.view.lens.focus_distance = 3;
    return scene;
}

struct Named {
    const char* name;
    Scene scene;
};
std::vector<Named> scenes_with_highlights() {
    return {{"mirror", lamps_in_a_mirror()},
            {"two mirrors", lamps_in_two_mirrors()},
            {"glass", lamp_in_glass()},
            {"sun", sun_in_a_mirror_out_of_focus()}};
}

TEST(SmoothHighlights, KeepTheMean) {
    const auto scenes = scenes_with_highlights();
    const double alpha = statistics::sidak(statistics::significance, int64_t(scenes.size()));
    for (const auto& [name, scene] : scenes) {
        RenderSettings settings = quick_settings(64, 48, 128);
        settings.sampler = SamplerType::random;
        const auto alone = render(scene, settings).blocks(16, 16);
        settings.seed = 3;
        const RenderedImage image = render(scene, smooth(settings));
        EXPECT_TRUE(has_highlights(image.frame)) << name << ": " << decision(image.frame);
        EXPECT_TRUE(same_means(alone, image.blocks(16, 16), alpha)) << name;
    }
}

// Pixels take at least 64 samples of the lamp's light for each sample, so less than an eighth of their variance remains.
TEST(SmoothHighlights, HaveLessNoise) {
    RenderSettings settings = quick_settings(64, 48, 16);
    settings.sampler = SamplerType::random;
    Moments fall; // an eighth of the variance before, less that after
    for (settings.seed = 0; settings.seed < 24; ++settings.seed) {
        const RenderedImage rough = render(lamps_in_a_mirror(), settings), refined = render(lamps_in_a_mirror(), smooth(settings));
        double before = 0, after = 0;
        for (size_t i = 0; i < rough.pixels.size(); ++i) {
            if (rough.pixels[i].y == refined.pixels[i].y) continue;
            before += rough.errors[i].y * rough.errors[i].y;
            after += refined.errors[i].y * refined.errors[i].y;
        }
        fall.add(before / 8 - after);
    }
    EXPECT_GT(fall.mean, 4 * fall.error()) << "less than an eighth must remain";
}

// Over many seeds the squared standard error of a pixel is the variance of its mean: the halves are independent.
TEST(SmoothHighlights, KeepTheErrorEstimateCalibrated) {
    RenderSettings settings = quick_settings(64, 48, 8);
    const RenderedImage rough = render(lamps_in_a_mirror(), settings), refined = render(lamps_in_a_mirror(), smooth(settings));
    std::vector<Moments> values(rough.pixels.size()), squares(rough.pixels.size());
    for (settings.seed = 1; settings.seed <= 40; ++settings.seed) {
        const RenderedImage image = render(lamps_in_a_mirror(), smooth(settings));
        for (size_t i = 0; i < values.size(); ++i) {
            values[i].add(image.pixels[i].y);
            squares[i].add(image.errors[i].y * image.errors[i].y);
        }
    }
    Moments share;
    for (size_t i = 0; i < values.size(); ++i)
        if (rough.pixels[i].y != refined.pixels[i].y && values[i].variance() + squares[i].mean > 0)
            share.add((values[i].variance() - squares[i].mean) / (values[i].variance() + squares[i].mean));
    EXPECT_GT(share.count, 3);
    EXPECT_TRUE(statistics::z_test(share, 0));
}

TEST(SmoothHighlights, DoNotDependOnThreadsAndRanges) {
    for (const auto& [name, scene] : scenes_with_highlights())
        for (const int reuse : {1, 8}) {
            RenderSettings settings = smooth(quick_settings(64, 48, 8));
            settings.reuse = reuse;
            const Frame once = render_in_steps(scene, settings, all_planes(1), {8});
            ASSERT_TRUE(has_highlights(once)) << name;
            EXPECT_TRUE(same_pixels(once, render_in_steps(scene, settings, all_planes(2), {8}))) << name;
            EXPECT_TRUE(same_pixels(once, render_in_steps(scene, settings, all_planes(2), {1, 3, 8}))) << name;
        }
}

TEST(SmoothHighlights, WithAdaptiveSamplingDoNotDependOnThreadsAndRanges) {
    RenderSettings settings = smooth(settings_for(64, 48, 40));
    settings.adaptive = true;
    const Frame once = render_in_steps(lamp_in_glass(), settings, all_planes(1), {40});
    EXPECT_TRUE(same_pixels(once, render_in_steps(lamp_in_glass(), settings, all_planes(2), {7, 23, 40})));
}

TEST(SmoothHighlights, AreTheSameInEachInstructionSet) {
    const RenderSettings settings = smooth(settings_for(48, 36, 4));
    const Frame widest = render_in_steps(lamp_in_glass(), settings, all_planes(1), {4});
    ASSERT_TRUE(has_highlights(widest));
    for_each_isa([&](const std::string& isa) {
        EXPECT_TRUE(same_pixels(widest, render_in_steps(lamp_in_glass(), settings, all_planes(1), {4}))) << isa;
    });
}

TEST(SmoothHighlights, ContinueASavedFilm) {
    const RenderSettings settings = smooth(settings_for(64, 48, 8));
    Renderer whole({.threads = 2});
    whole.update(lamp_in_glass(), settings);
    whole.render(0, 8);
    const Frame expected = whole.resolve();
    ASSERT_TRUE(has_highlights(expected));
    for (const int64_t split : {1, 3}) {
        Renderer begun({.threads = 2}), continued({.threads = 2});
        for (Renderer* r : {&begun, &continued}) r->update(lamp_in_glass(), settings);
        begun.render(0, split);
        ASSERT_TRUE(continued.load_film(*begun.save_film(0)));
        continued.render(split, 8 - split);
        EXPECT_TRUE(same_pixels(continued.resolve(), expected)) << split;
    }
}

// The light of a lamp behind one mirror is that of one scattering, behind two that of two.
TEST(SmoothHighlights, SumToTheBeautyByBouncesAndGroups) {
    RendererOptions options{.threads = 2};
    options.planes.bounces = 4;
    Scene scene = lamps_in_two_mirrors();
    scene.mix.grouping = LightMix::Grouping::by_light;
    const RenderSettings settings = quick_settings(64, 48, 8);
    const Frame rough = render_in_steps(scene, settings, options, {1, 8});
    const Frame refined = render_in_steps(scene, smooth(settings), options, {1, 8});
    ASSERT_TRUE(has_highlights(refined));
    EXPECT_EQ(rough.bounces[0], refined.bounces[0]) << "no lamp is in view";
    EXPECT_NE(rough.bounces[1], refined.bounces[1]);
    ASSERT_GT(refined.groups.size(), 1u);
    for (size_t i = 0; i < refined.bounces[0].size(); ++i) {
        double by_bounce = 0, by_group = 0;
        for (const auto& plane : refined.bounces) {
            EXPECT_GE(plane[i].y, 0);
            by_bounce += double(plane[i].y);
        }
        for (const auto& group : refined.groups) by_group += double(group[i].y);
        const double beauty = double(refined.rgba[4 * i + 1]);
        EXPECT_NEAR(by_bounce, beauty, beauty * 1e-6);
        EXPECT_NEAR(by_group, beauty, beauty * 1e-6);
    }
}

TEST(SmoothHighlights, AreLeftOutWhereTheyDoNotFit) {
    RenderSettings settings = smooth(quick_settings(64, 48, 4));
    settings.clamp = {4, false};
    EXPECT_FALSE(has_highlights(render(lamps_in_a_mirror(), settings).frame));
    settings.clamp = {};
    settings.roulette.rule = Roulette::Rule::splitting;
    EXPECT_FALSE(has_highlights(render(lamps_in_a_mirror(), settings).frame));
    settings.roulette = {};
    settings.max_bounces = 1;
    EXPECT_TRUE(has_highlights(render(lamps_in_a_mirror(), settings).frame));
    settings.smooth_edges = false;
    EXPECT_EQ(decision(render(lamps_in_a_mirror(), settings).frame), "switched off");
}

// Most of the noise of the glass is of thousands of faint images of its lamp, for which one sample by all lobes is enough. In the ring all
// of it is of those that it has measured; through an aperture, where samples do not aim, these take more of them.
TEST(SmoothHighlights, TakeTheMostSamplesOnlyWhereTheNoiseIs) {
    const auto bright = [](const std::string& why) { return why.find(fmt::format(", {} paths", bright_highlight_samples)) < why.size(); };
    const RenderSettings settings = smooth(settings_for(320, 180, 2));
    const Frame glass = render_in_steps(shipped_scene("wine-glass"), settings, {.threads = 2}, {2});
    EXPECT_TRUE(has_highlights(glass)) << decision(glass);
    EXPECT_FALSE(bright(decision(glass))) << decision(glass);
    EXPECT_NE(decision(glass).find("with faint images of lamps"), std::string::npos) << decision(glass);
    Scene ring = shipped_scene("metal-ring");
    const auto work = [&] {
        const std::string why = decision(render_in_steps(ring, settings, {.threads = 2}, {2}));
        int few = 0, each = 0, many = 0;
        EXPECT_EQ(std::sscanf(why.c_str(), "pilot: %d pixels with highlights of lamps in smooth surfaces, %d paths a sample; %d", &few,
                              &each, &many),
                  3)
            << why;
        EXPECT_TRUE(bright(why)) << why;
        return few * highlight_samples + many * bright_highlight_samples;
    };
    const int aimed = work();
    ring.view.lens.aperture_radius = 1e-6f;
    EXPECT_LT(aimed, work());
}

// Without, both halves miss them (highlight_pilot_test.cpp).
TEST(SmoothHighlights, MakeTheErrorOfARingKnown) {
    const RenderSettings settings = settings_for(320, 180, 16);
    const Scene ring = shipped_scene("metal-ring");
    EXPECT_TRUE(render_in_steps(ring, settings, {.threads = 2}, {16}).error.misses_highlights);
    const ErrorEstimate error = render_in_steps(ring, smooth(settings), {.threads = 2}, {16}).error;
    EXPECT_FALSE(error.misses_highlights);
    EXPECT_TRUE(error.rmse_known);
}

} // namespace
} // namespace blush::test::TEST_FILE
