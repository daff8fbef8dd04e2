// Smooth edges: the same mean with less noise at edges of visible emitters, however the image is rendered; all planes fit.
#include "render/film/edges/edge_samples.h"
#include "render/film/film_state.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace blush::test::TEST_FILE {
namespace {

using statistics::Moments;

RenderSettings smooth(RenderSettings settings) {
    settings.smooth_edges = true;
    return settings;
}

FeatureUse line_of(const FeatureReport& report) {
    const auto found = std::ranges::find(report, "smooth edges", &FeatureUse::name);
    return found == report.end() ? FeatureUse{} : *found;
}

// After the pilot, if there is one.
FeatureUse decided(const Scene& scene, const RenderSettings& settings) {
    Renderer renderer({.threads = 2});
    renderer.update(scene, settings);
    EXPECT_TRUE(renderer.decide());
    return line_of(*renderer.feature_report());
}

// A lamp in front of nothing.
Scene lamp() {
    Scene scene;
    place(scene, quad({-0.5f, -0.4f, 0}, {0.5f, -0.5f, 0}, {0.4f, 0.5f, 0}, {-0.6f, 0.3f, 0}), emitter(50));
    scene.view = looking({0, 0, 3}, {0, 0, 0}, 0.6f);
    return scene;
}

Scene lamp_over_floor() {
    Scene scene = lamp();
    place(scene, floor_quad(4, -0.8f), lambert({0.5f, 0.4f, 0.3f}));
    place(scene, quad({-4, -2, -2}, {4, -2, -2}, {4, 4, -2}, {-4, 4, -2}), lambert(0.3f));
    return scene;
}

// The edges of the lamp are out of focus.
Scene lamp_out_of_focus() {
    Scene scene = lamp_over_floor();
    scene.view.lens.aperture_radius = 0.02f;
    scene.view.lens.focus_distance = 4.5f;
    return scene;
}

Scene sun_disk() {
    Scene scene;
    place(scene, floor_quad(40, -1), lambert(0.4f));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 3;
    sun.angle_radians = 0.15f;
    place_light(scene, sun, aimed({0, 0, 0}, {0.1f, -0.2f, 1}));
    scene.view = looking({0, 0, 0}, {-0.1f, 0.15f, -1}, 0.6f);
    return scene;
}

// A dark bar in front of the sky.
Scene window() {
    Scene scene;
    constant_world(scene, 5);
    place(scene, quad({-0.2f, -3, 0}, {0.1f, -3, 0}, {0.4f, 3, 0}, {0.1f, 3, 0}), lambert(0.05f));
    scene.view = looking({0, 0, 3}, {0, 0, 0}, 0.6f);
    return scene;
}

Scene sphere_light() {
    Scene scene;
    place(scene, floor_quad(4, -0.8f), lambert(0.5f));
    Light light;
    light.kind = Light::Kind::sphere;
    light.intensity = 40;
    light.radius = 0.3f;
    place_light(scene, light, at({0.1f, 0, 0}));
    scene.view = looking({0, 0, 3}, {0, 0, 0}, 0.6f);
    return scene;
}

struct Named {
    const char* name;
    Scene scene;
};
std::vector<Named> scenes_with_edges() {
    return {{"lamp", lamp()},
            {"lamp over a floor", lamp_over_floor()},
            {"lamp out of focus", lamp_out_of_focus()},
            {"sun disk", sun_disk()},
            {"window", window()},
            {"sphere light", sphere_light()}};
}

bool differ(const Vec3d& a, const Vec3d& b) { return a.x != b.x || a.y != b.y || a.z != b.z; }

TEST(SmoothEdges, KeepTheMean) {
    const auto scenes = scenes_with_edges();
    const double alpha = statistics::sidak(statistics::significance, int64_t(scenes.size()));
    for (const auto& [name, scene] : scenes) {
        RenderSettings settings = settings_for(64, 48, 128);
        settings.sampler = SamplerType::random;
        const auto alone = render(scene, settings).blocks(16, 16);
        settings.seed = 3;
        const RenderedImage image = render(scene, smooth(settings));
        EXPECT_TRUE(line_of(*image.frame.feature_report).used) << name;
        EXPECT_TRUE(same_means(alone, image.blocks(16, 16), alpha)) << name;
    }
}

// With independent numbers, in front of nothing, the variance is that of the emission alone: 1 / M of it remains.
TEST(SmoothEdges, LeaveAnMthOfTheVarianceOfTheEmission) {
    RenderSettings settings = settings_for(96, 64, 16);
    settings.sampler = SamplerType::random;
    Moments difference, before_all, after_all; // by image: M times the variance with smooth edges less that without
    for (settings.seed = 0; settings.seed < 40; ++settings.seed) {
        const RenderedImage rough = render(lamp(), settings), refined = render(lamp(), smooth(settings));
        double before = 0, after = 0;
        for (size_t i = 0; i < rough.pixels.size(); ++i) {
            if (!differ(rough.pixels[i], refined.pixels[i])) continue;
            before += rough.errors[i].y * rough.errors[i].y;
            after += refined.errors[i].y * refined.errors[i].y;
        }
        difference.add(edge_samples * after - before);
        before_all.add(before);
        after_all.add(after);
    }
    EXPECT_TRUE(statistics::z_test(difference, 0));
    EXPECT_LT(after_all.mean * edge_samples / 2, before_all.mean);
}

TEST(SmoothEdges, LowerTheErrorOfAnImageWithALamp) {
    const RenderSettings settings = settings_for(96, 64, 16);
    const ErrorEstimate rough = render(lamp_over_floor(), settings).frame.error;
    const ErrorEstimate refined = render(lamp_over_floor(), smooth(settings)).frame.error;
    EXPECT_LT(refined.rmse_high, rough.rmse_low);
}

// Over many seeds the squared standard error of a pixel is the variance of its mean: the halves are independent.
TEST(SmoothEdges, KeepTheErrorEstimateCalibrated) {
    constexpr int seeds = 48;
    RenderSettings settings = settings_for(96, 64, 8);
    for (const SamplerType sampler : {SamplerType::sobol, SamplerType::random}) {
        settings.sampler = sampler;
        settings.seed = 0;
        const RenderedImage rough = render(lamp_over_floor(), settings);
        const RenderedImage refined = render(lamp_over_floor(), smooth(settings));
        std::vector<Moments> values(rough.pixels.size()), squares(rough.pixels.size());
        for (settings.seed = 1; settings.seed <= seeds; ++settings.seed) {
            const RenderedImage image = render(lamp_over_floor(), smooth(settings));
            for (size_t i = 0; i < values.size(); ++i) {
                values[i].add(image.pixels[i].y);
                squares[i].add(image.errors[i].y * image.errors[i].y);
            }
        }
        // Both sides of each pixel relative to their sum, so that no pixel outweighs the others.
        Moments share;
        for (size_t i = 0; i < values.size(); ++i)
            if (differ(rough.pixels[i], refined.pixels[i]) && values[i].variance() + squares[i].mean > 0)
                share.add((values[i].variance() - squares[i].mean) / (values[i].variance() + squares[i].mean));
        EXPECT_GT(share.count, 30);
        EXPECT_TRUE(statistics::z_test(share, 0, statistics::sidak(statistics::significance, 2)));
    }
}

TEST(SmoothEdges, DoNotDependOnThreadsRangesAndTiles) {
    for (const auto& [name, scene] : scenes_with_edges())
        for (const int reuse : {1, 8}) {
            RenderSettings settings = smooth(settings_for(80, 45, 8));
            settings.reuse = reuse;
            const Frame once = render_in_steps(scene, settings, all_planes(1), {8});
            ASSERT_TRUE(line_of(*once.feature_report).used) << name;
            EXPECT_TRUE(same_pixels(once, render_in_steps(scene, settings, all_planes(2), {8}))) << name;
            EXPECT_TRUE(same_pixels(once, render_in_steps(scene, settings, all_planes(2), {3, 8}))) << name;
            EXPECT_TRUE(same_pixels(once, render_in_steps(scene, settings, all_planes(1), {1, 2, 4, 8}))) << name;
        }
}

TEST(SmoothEdges, WithAdaptiveSamplingDoNotDependOnThreadsAndRanges) {
    RenderSettings settings = smooth(settings_for(80, 45, 40));
    settings.adaptive = true;
    const Frame once = render_in_steps(lamp_over_floor(), settings, all_planes(1), {40});
    EXPECT_TRUE(same_pixels(once, render_in_steps(lamp_over_floor(), settings, all_planes(2), {7, 23, 40})));
}

TEST(SmoothEdges, AreTheSameInEachInstructionSet) {
    const RenderSettings settings = smooth(settings_for(48, 32, 4));
    const Frame widest = render_in_steps(lamp_out_of_focus(), settings, all_planes(1), {4});
    for_each_isa([&](const std::string& isa) {
        EXPECT_TRUE(same_pixels(widest, render_in_steps(lamp_out_of_focus(), settings, all_planes(1), {4}))) << isa;
    });
}

TEST(SmoothEdges, ContinueASavedFilm) {
    const RenderSettings settings = smooth(settings_for(64, 48, 8));
    Renderer whole({.threads = 2});
    whole.update(lamp_over_floor(), settings);
    whole.render(0, 8);
    for (const int64_t split : {1, 3}) {
        Renderer begun({.threads = 2}), continued({.threads = 2});
        for (Renderer* r : {&begun, &continued}) r->update(lamp_over_floor(), settings);
        begun.render(0, split);
        ASSERT_TRUE(continued.load_film(*begun.save_film(0)));
        continued.render(split, 8 - split);
        EXPECT_TRUE(same_pixels(continued.resolve(), whole.resolve())) << split;
    }
}

// A larger scene is the same image: no decision depends on a length.
TEST(SmoothEdges, DoNotDependOnTheUnitOfLength) {
    const Scene scene = lamp_over_floor();
    Scene large = scene;
    for (const auto& [id, node] : scene.nodes) {
        Node scaled = node;
        scaled.local.scale = {1024, 1024, 1024};
        large.nodes.set(id, scaled);
    }
    large.view.position = scene.view.position * 1024.0;
    const RenderSettings settings = smooth(settings_for(64, 48, 4));
    EXPECT_EQ(render(scene, settings).frame.rgba, render(large, settings).frame.rgba);
}

// The difference is emission at the first hit: only the first bounce plane changes, and no first-hit plane.
TEST(SmoothEdges, ChangeThePlaneOfEmissionOnly) {
    RendererOptions options = all_planes(2);
    options.planes.bounces = 4;
    for (const Clamp& clamp : {Clamp{}, Clamp{0.05f, false}}) {
        RenderSettings settings = settings_for(64, 48, 8);
        settings.clamp = clamp;
        const Frame rough = render_in_steps(lamp_over_floor(), settings, options, {8});
        const Frame refined = render_in_steps(lamp_over_floor(), smooth(settings), options, {8});
        EXPECT_NE(rough.bounces[0], refined.bounces[0]);
        EXPECT_EQ(rough.albedo, refined.albedo);
        EXPECT_EQ(rough.normal, refined.normal);
        EXPECT_EQ(rough.depth, refined.depth);
        EXPECT_EQ(rough.object_id, refined.object_id);
        for (size_t i = 0; i < refined.bounces[0].size(); ++i) {
            double sum = 0;
            for (size_t k = 0; k < refined.bounces.size(); ++k) {
                sum += double(refined.bounces[k][i].y);
                const float before = rough.bounces[k][i].y;
                if (k > 0) { EXPECT_NEAR(refined.bounces[k][i].y, before, 1e-6f * (1 + before)); }
            }
            EXPECT_NEAR(sum, double(refined.rgba[4 * i + 1]), sum * 0x1.01p-22);
        }
    }
}

TEST(SmoothEdges, LightGroupsSumToTheBeauty) {
    Scene scene = lamp_over_floor();
    Light light;
    light.kind = Light::Kind::sphere;
    light.intensity = 30;
    light.radius = 0.1f;
    place_light(scene, light, at({0.5f, 0.3f, 0.2f})); // in front of the lamp
    constant_world(scene, 0.1f);
    scene.mix.grouping = LightMix::Grouping::by_light;
    for (const Clamp& clamp : {Clamp{}, Clamp{0.05f, false}}) {
        RenderSettings settings = smooth(settings_for(64, 48, 8));
        settings.clamp = clamp;
        const Frame frame = render_in_steps(scene, settings, {.threads = 2}, {8});
        ASSERT_TRUE(line_of(*frame.feature_report).used);
        ASSERT_GT(frame.groups.size(), 1u);
        for (size_t i = 0; i < frame.groups[0].size(); ++i) {
            double sum = 0;
            for (const auto& group : frame.groups) {
                EXPECT_GE(group[i].y, 0);
                sum += double(group[i].y);
            }
            EXPECT_NEAR(sum, double(frame.rgba[4 * i + 1]), sum * 1e-6);
        }
    }
}

// A kernel without a scene: the emission of a sample is its index, and of one of them not finite.
constexpr int64_t bad_sample = 2 * 5 * edge_samples + 2; // among those for sample 10
std::vector<int64_t> emission_indices;                   // that were asked for, in order

void render_indices(const KernelContext& context, const TileJob& job, TileScratch& tile) {
    for (int slot = 0; slot < job.paths(); ++slot) {
        const int64_t sample = job.sample(slot % job.samples);
        const bool more = context.seed != 0;
        if (more) emission_indices.push_back(sample);
        const bool bad = more && sample == bad_sample;
        tile.r[slot] = tile.g[slot] = tile.b[slot] = bad ? std::numeric_limits<double>::infinity() : double(sample);
    }
}

// Refines samples whose radiance is their index, their emission, plus 1000.
std::vector<double> refined(int64_t first, int samples, int stride) {
    const Kernel kernel{"", "", {}, render_indices, render_indices};
    const auto tile = std::make_unique<TileScratch>();
    const auto scratch = std::make_unique<EdgeScratch>();
    const TileJob job{.x = 3, .y = 2, .width = 2, .height = 1, .first_sample = first, .samples = samples, .stride = stride};
    for (int slot = 0; slot < job.paths(); ++slot) tile->r[slot] = double(job.sample(slot % samples)) + 1000;
    EdgePixels pixels(8, 8);
    pixels.add(4, 2);
    const SceneTables empty{};
    refine_emission({.scene = &empty}, kernel, pixels, job, *tile, *scratch);
    for (int s = 0; s < samples; ++s) EXPECT_EQ(tile->r[s], double(job.sample(s)) + 1000) << "no pixel of an edge";
    return std::vector<double>(tile->r.data + samples, tile->r.data + 2 * samples);
}

TEST(SmoothEdges, ContinueOneSequenceInEachHalf) {
    emission_indices.clear();
    std::vector<double> radiance = refined(0, 3, 1);
    for (const double r : refined(3, 6, 1)) radiance.push_back(r);
    std::ranges::sort(emission_indices);
    ASSERT_EQ(emission_indices.size(), size_t(9 * edge_samples));
    // Five even samples and four odd ones.
    for (int64_t i = 0; i < 5 * edge_samples; ++i)
        EXPECT_TRUE(std::ranges::binary_search(emission_indices, 2 * i) &&
                    (i >= 4 * edge_samples) != std::ranges::binary_search(emission_indices, 2 * i + 1))
            << i;
    for (int64_t s = 0; s < 9; ++s) {
        const double mean = double(2 * (s / 2) * edge_samples + s % 2) + edge_samples - 1;
        EXPECT_EQ(radiance[size_t(s)], 1000 + mean) << s;
    }
    EXPECT_EQ(refined(1, 4, 2), (std::vector<double>{radiance[1], radiance[3], radiance[5], radiance[7]})) << "one half";
}

TEST(SmoothEdges, LeaveASampleThatMeetsAFault) {
    const std::vector<double> radiance = refined(8, 4, 1);
    EXPECT_EQ(radiance[2], 1010);
    for (const size_t s : {0, 1, 3}) EXPECT_NE(radiance[s], 1008 + double(s));
}

TEST(SmoothEdges, NeedNoPilotWhereTheyCannotGain) {
    const RenderSettings settings = smooth(settings_for(64, 48, 4));
    EXPECT_EQ(decided(lamp(), settings_for(64, 48, 4)).why, "switched off");
    Scene dark = lamp_over_floor();
    dark.view = looking({0, 0, 3}, {0, -0.8f, 1}, 0.3f);
    EXPECT_EQ(decided(dark, settings).why, "pilot: edges and highlights of visible light sources have too small a share of the noise");

    Scene lit;
    place(lit, floor_quad(4, -0.8f), lambert(0.5f));
    Light light;
    light.kind = Light::Kind::point;
    place_light(lit, light, at({0, 1, 0}));
    lit.view = looking({0, 0, 3}, {0, 0, 0}, 0.6f);
    EXPECT_EQ(decided(lit, settings).why, "the camera sees no light source");
    light.kind = Light::Kind::rectangle;
    light.visible_to_camera = false;
    place_light(lit, light, at({0, 0, 0}));
    light.kind = Light::Kind::sphere;
    light.radius = 0.2f;
    place_light(lit, light, at({0, 0, 0}));
    light.kind = Light::Kind::sun;
    light.angle_radians = 0.1f;
    place_light(lit, light, aimed({0, 0, 0}, {0, -1, 0}));
    constant_world(lit, 1);
    lit.environment.visible_to_camera = false;
    EXPECT_EQ(decided(lit, settings).why, "the camera sees no light source");

    RenderSettings special = settings;
    special.max_bounces = 0;
    EXPECT_EQ(decided(lamp(), special).why, "paths end at their first hit");
    special = settings;
    special.clamp = {4, true};
    EXPECT_EQ(decided(lamp(), special).why, "all light is clamped");
    lit.environment.visible_to_camera = true;
    EXPECT_NE(decided(lit, settings).why, "the camera sees no light source");
    Scene composited = lamp_over_floor();
    constant_world(composited, 1);
    composited.environment.visible_to_camera = false;
    EXPECT_EQ(decided(composited, settings).why, "the background is transparent");
    Scene caught = lamp_over_floor();
    constant_world(caught, 1);
    const Id<Node> floor = caught.nodes.begin()->id;
    Node catcher = *caught.nodes.find(floor);
    catcher.shadow_catcher = true;
    caught.nodes.set(floor, catcher);
    place(caught, quad({-0.2f, -0.2f, 1}, {0.2f, -0.2f, 1}, {0.2f, 0.2f, 1}, {-0.2f, 0.2f, 1}), emitter(9));
    EXPECT_EQ(decided(caught, settings).why, "there is a shadow catcher");
}

TEST(SmoothEdges, DoNotDelayTheFirstSampleOrACoarseImage) {
    Renderer renderer({.threads = 2});
    renderer.update(lamp_over_floor(), smooth(settings_for(64, 48, 4)));
    const auto why = [&] { return line_of(*renderer.feature_report()).why; };
    renderer.set_divider(2);
    renderer.render(0, 4);
    renderer.set_divider(1);
    renderer.render(0, 1);
    EXPECT_EQ(why(), "a pilot finds the pixels after the first sample");
    const Frame first = renderer.resolve();
    EXPECT_EQ(first.rgba, fresh_image(lamp_over_floor(), settings_for(64, 48, 1), 1).rgba);
    EXPECT_FALSE(renderer.render(1, 1, [] { return false; }));
    EXPECT_EQ(why(), "a pilot finds the pixels after the first sample") << "stopped";
    EXPECT_TRUE(renderer.save_film(0)) << "stopped before the sample began";
    renderer.render(1, 1);
    EXPECT_EQ(why().substr(0, 6), "pilot:");
}

} // namespace
} // namespace blush::test::TEST_FILE
