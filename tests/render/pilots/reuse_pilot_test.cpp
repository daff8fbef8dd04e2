// The pilot of path reuse: its decision, that the decision does not depend on how the image is rendered, and that it adds no bias.
#include "render/pilots/reuse_pilot.h"

#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/film/film_merger.h"
#include "render/film/film_state.h"
#include "render/integrator/kernel_settings.h"
#include "render/pilots/reuse_choice.h"
#include "tests/render/pilots/pilot_checks.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace blush::test::TEST_FILE {
namespace {

RenderSettings automatic(int width, int height, int64_t spp) {
    RenderSettings settings = settings_for(width, height, spp);
    settings.reuse = reuse_auto;
    return settings;
}

constexpr const char* feature = "path reuse";
FeatureUse line_of(Renderer& renderer) { return feature_line(renderer, feature); }

FeatureUse decided(const Scene& scene, const RenderSettings& settings, unsigned threads = 2) {
    return decided_line(scene, settings, feature, threads);
}

// A white room; light comes through a window, from the sky onto the floor.
Scene window_room() {
    Scene scene;
    place(scene, quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}), lambert(0.7f));
    place(scene, ceiling_quad(2, 3), lambert(0.8f));
    place(scene, quad({-2, 0, -2}, {2, 0, -2}, {2, 3, -2}, {-2, 3, -2}), lambert(0.8f));
    place(scene, quad({-2, 0, 2}, {-2, 0, -2}, {-2, 3, -2}, {-2, 3, 2}), lambert({0.8f, 0.5f, 0.4f}));
    place(scene, quad({2, 0, 2}, {-2, 0, 2}, {-2, 3, 2}, {2, 3, 2}), lambert(0.8f));
    place(scene, quad({2, 0, -2}, {2, 0, 2}, {2, 1, 2}, {2, 1, -2}), lambert(0.8f));
    place(scene, quad({2, 1, -2}, {2, 1, 0.5f}, {2, 3, 0.5f}, {2, 3, -2}), lambert(0.8f));
    place(scene, quad({2, 2, 0.5f}, {2, 2, 2}, {2, 3, 2}, {2, 3, 0.5f}), lambert(0.8f));
    constant_world(scene, 1);
    scene.view = looking({-1.2f, 1.5f, 1.5f}, {0.5f, 1, -1}, 1.2f);
    return scene;
}

// Diffuse balls on a diffuse floor under an open sky: the little light between them costs more than it gains.
Scene open_field() {
    Scene scene;
    place(scene, floor_quad(20), lambert(0.3f));
    for (int i = 0; i < 3; ++i) place(scene, sphere(false), lambert(0.5f), at({3.f * float(i - 1), 1, 0}));
    constant_world(scene, 1);
    scene.view = looking({0, 2, 9}, {0, 1, 0}, 0.7f);
    return scene;
}

Scene shiny(const Material& material) {
    Scene scene;
    place(scene, floor_quad(20), metal(0.2f));
    place(scene, sphere(false), material, at({0, 1, 0}));
    constant_world(scene, 1);
    scene.view = looking({0, 2, 5}, {0, 1, 0}, 0.7f);
    return scene;
}

TEST(ReusePilot, UsesPathReuseWhereItGains) {
    for (const Scene& scene : {shipped_scene("cornell"), shipped_scene("corridor"), window_room()}) {
        const FeatureUse use = decided(scene, automatic(192, 128, 64));
        ASSERT_TRUE(use.pilot);
        EXPECT_TRUE(use.used) << use.why;
        EXPECT_LT(use.pilot->cost(), 0.9) << use.why;
        EXPECT_GT(use.pilot->work, 1);
    }
}

TEST(ReusePilot, LeavesPathReuseOutWhereItGainsLittle) {
    const FeatureUse use = decided(open_field(), automatic(192, 128, 64));
    ASSERT_TRUE(use.pilot);
    EXPECT_FALSE(use.used) << use.why;
    EXPECT_GT(use.pilot->cost(), 1);
}

TEST(ReusePilot, IsNotAskedWhereThereIsNothingToShare) {
    for (const Material& material : {glass(0, 1.5f), plastic(0.3f), metal(0)}) {
        const FeatureUse use = decided(shiny(material), automatic(64, 48, 4));
        EXPECT_FALSE(use.pilot || use.used);
        EXPECT_EQ(use.why, "no surface is Lambertian: there is no light to share");
    }
    EXPECT_TRUE(decided(shiny(lambert(0.5f)), automatic(64, 48, 4)).pilot);
    EXPECT_FALSE(decided(shiny(lambert(0)), automatic(64, 48, 4)).pilot) << "black";
    RenderSettings short_paths = automatic(64, 48, 4);
    short_paths.max_bounces = 1;
    EXPECT_EQ(decided(shipped_scene("cornell"), short_paths).why, "paths end before they have light to share");
    short_paths.max_bounces = 2;
    EXPECT_TRUE(decided(shipped_scene("cornell"), short_paths).pilot);
}

// A texture may take the reflection away.
TEST(ReusePilot, KnowsThatATextureCanMakeASurfaceLambertian) {
    Scene scene = shiny(plastic(0.3f));
    const std::array<Vec3, 1> texel{{{1, 1, 1}}};
    Material material = plastic(0.3f);
    material.specular_texture.texture = add_texture(scene, float_image(1, 1, texel));
    place(scene, sphere(false), material, at({3, 1, 0}));
    EXPECT_TRUE(decided(scene, automatic(64, 48, 4)).pilot);
}

TEST(ReusePilot, FollowsASettingWithoutMeasuring) {
    RenderSettings settings = settings_for(64, 48, 4);
    EXPECT_EQ(decided(shipped_scene("cornell"), settings).why, "switched off");
    settings.reuse = 4;
    const FeatureUse use = decided(shipped_scene("cornell"), settings);
    EXPECT_TRUE(use.used && !use.pilot) << use.why;
}

// ---- independence

TEST(ReusePilot, DoesNotDependOnThreadsSeedStopRulesOrRegion) {
    const Scene scene = window_room();
    const RenderSettings settings = automatic(80, 48, 16);
    const PilotFigures expected = *decided(scene, settings, 1).pilot;
    EXPECT_EQ(*decided(scene, settings, 2).pilot, expected);
    EXPECT_EQ(*decided(scene, settings, 5).pilot, expected);
    RenderSettings other = settings;
    other.seed = 7;
    other.spp = 3;
    other.region = {0.5f, 0.5f, 0.25f, 0.25f};
    other.adaptive = true;
    EXPECT_EQ(*decided(scene, other).pilot, expected);
    other.max_bounces = 2;
    EXPECT_NE(*decided(scene, other).pilot, expected);
}

TEST(ReusePilot, IsTheSameWithEveryKernel) {
    const Scene scene = shipped_scene("corridor");
    const RenderSettings settings = automatic(64, 48, 4);
    const Workers workers(2);
    RenderScene compiled;
    compiled.update(expand_area_lights(scene), settings, full_plan(), workers);
    const KernelContext context{&compiled.tables(), &compiled.accel(), kernel_settings(settings, settings.width, settings.height)};
    std::vector<std::unique_ptr<TileScratch>> scratch(workers.threads());
    const auto measure = [&](const Kernel& kernel) { return *measure_path_reuse(context, kernel, workers, scratch, {}); };
    const PilotFigures expected = measure(kernels_of("scalar").back());
    for (const std::string_view isa : runnable_isas()) {
        const auto kernels = kernels_of(isa);
        const auto smallest = std::ranges::find_if(kernels, [&](const Kernel& k) { return k.features.contains(compiled.features()); });
        EXPECT_EQ(measure(*smallest), expected) << isa;
    }
}

TEST(ReusePilot, IsTheSameAfterAnEditAsAfterAFreshStart) {
    Scene scene = window_room(), dark = scene;
    dark.environment.intensity = 0.01f;
    const RenderSettings settings = automatic(80, 48, 4);
    Renderer renderer(all_planes());
    for (const Scene& next : {scene, open_field(), dark, scene}) {
        renderer.update(next, settings);
        renderer.render(0, 4);
        EXPECT_EQ(line_of(renderer).pilot, decided(next, settings).pilot);
        EXPECT_TRUE(same_pixels(renderer.resolve(), fresh_image(next, settings, 4)));
    }
}

// ---- which samples are shared

TEST(ReusePilot, DecidesOverAllSamplesButTheFirst) {
    for (const auto& [scene, size] : {std::pair{window_room(), 16}, std::pair{open_field(), 1}}) {
        RenderSettings settings = automatic(80, 48, 8), chosen = settings, shared = settings;
        chosen.reuse = size;
        shared.reuse = 8;
        EXPECT_TRUE(same_pixels(rendered_in_parts(scene, settings, {{1, 7}}), rendered_in_parts(scene, chosen, {{1, 7}}))) << size;
        EXPECT_TRUE(same_pixels(rendered_in_parts(scene, settings, {{0, 1}}), rendered_in_parts(scene, shared, {{0, 1}}))) << size;
        const Frame whole = rendered_in_parts(scene, settings, {{0, 8}});
        EXPECT_TRUE(same_pixels(whole, rendered_in_parts(scene, settings, {{0, 1}, {1, 7}}))) << size;
        EXPECT_TRUE(same_pixels(whole, rendered_in_parts(scene, settings, {{0, 5}, {5, 3}}))) << size;
        settings.adaptive = true;
        EXPECT_TRUE(
            same_pixels(rendered_in_parts(scene, settings, {{0, 1}, {0, 1}, {0, 22}}), rendered_in_parts(scene, settings, {{0, 24}})))
            << size;
    }
}

TEST(ReusePilot, DoesNotDelayTheFirstSampleOrACoarseImage) {
    Renderer renderer({.threads = 2});
    renderer.update(open_field(), automatic(80, 48, 8));
    renderer.set_divider(2);
    renderer.render(0, 4);
    renderer.set_divider(1);
    renderer.render(0, 1);
    EXPECT_FALSE(line_of(renderer).pilot);
    EXPECT_TRUE(line_of(renderer).used);
    EXPECT_FALSE(renderer.render(1, 1, [] { return false; }));
    EXPECT_FALSE(line_of(renderer).pilot) << "stopped";
    EXPECT_TRUE(renderer.save_film(0)) << "stopped before the sample began";
    renderer.render(1, 1);
    EXPECT_TRUE(line_of(renderer).pilot);
    EXPECT_FALSE(line_of(renderer).used);
}

TEST(ReusePilot, IsSavedWithTheFilm) {
    const Scene scene = open_field();
    const RenderSettings settings = automatic(80, 48, 8);
    Renderer whole({.threads = 2}), begun({.threads = 2}), continued({.threads = 2});
    for (Renderer* r : {&whole, &begun, &continued}) r->update(scene, settings);
    whole.render(0, 8);
    begun.render(0, 3);
    FilmState state = *begun.save_film(0);
    EXPECT_EQ(state.reuse_pilot, line_of(whole).pilot);
    ASSERT_TRUE(continued.load_film(state));
    continued.render(3, 5);
    EXPECT_TRUE(same_pixels(continued.resolve(), whole.resolve()));
    // What another version of the program decided stays decided.
    state.reuse_pilot = PilotFigures{0.5, 0.5, 0.5, 1.2, 16};
    Renderer other({.threads = 2});
    other.update(scene, settings);
    ASSERT_TRUE(other.load_film(state));
    EXPECT_TRUE(line_of(other).used);
    other.render(3, 5);
    EXPECT_FALSE(same_pixels(other.resolve(), whole.resolve()));
    RenderSettings fixed = settings;
    fixed.reuse = 1;
    other.update(scene, fixed);
    ASSERT_TRUE(other.load_film(state));
    EXPECT_FALSE(line_of(other).used) << "a setting is stronger";
}

TEST(ReusePilot, MergesRanges) {
    const Scene scene = open_field();
    RenderSettings settings = automatic(80, 48, 8);
    Renderer renderer({.threads = 2, .is_part = true});
    renderer.update(scene, settings);
    const auto range = [&](int64_t first, int64_t count) {
        renderer.clear();
        renderer.render(first, count);
        return *renderer.save_film(first);
    };
    FilmState first = range(0, 1);
    first.reuse_pilot.reset(); // as of a render that ends here
    const Result<FilmState> sum = merge_films(first, range(1, 7), settings);
    ASSERT_TRUE(sum);
    EXPECT_EQ(sum->reuse_pilot, line_of(renderer).pilot);
    Renderer continued({.threads = 2});
    continued.update(scene, settings);
    ASSERT_TRUE(continued.load_film(*sum));
    continued.render(8, 4);
    const Frame a = continued.resolve(), b = fresh_image(scene, settings, 12);
    EXPECT_EQ(a.rgba, b.rgba);
}

TEST(ReusePilot, KeepsTheMean) {
    for (const Scene& scene : {window_room(), open_field()}) {
        RenderSettings settings = settings_for(64, 48, 64);
        const auto alone = render(scene, settings).blocks(16, 16);
        settings.reuse = reuse_auto;
        settings.seed = 3;
        // Pixels of a block are correlated, so the measured errors of blocks are too small: by at most the size of a group.
        auto shared = render(scene, settings).blocks(16, 16);
        for (Measured& m : shared) m.error = m.error * std::sqrt(8.0);
        EXPECT_TRUE(same_means(alone, shared));
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
