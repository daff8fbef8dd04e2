// Strategy planes: they sum to the beauty, hold what their strategy finds, and cost nothing if not requested.
#include "render/film/film_merger.h"
#include "render/film/film_state.h"
#include "render/film/found_by.h"
#include "tests/render/pilots/pilot_checks.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

#include <cstdlib>

namespace blush::test::TEST_FILE {
namespace {

constexpr size_t width = 24, height = 16, pixels = width * height;

Frame render_strategies(const Scene& scene, const RenderSettings& settings, bool strategies = true, unsigned threads = 1,
                        const CausticOptions& caustics = {}) {
    Renderer renderer({.threads = threads, .planes = {.strategies = strategies}, .caustics = caustics});
    renderer.update(scene, settings);
    renderer.render(settings.first_sample, settings.spp - settings.first_sample);
    return renderer.resolve();
}

double channel(const Vec3& v, int c) { return double(c == 0 ? v.x : c == 1 ? v.y : v.z); }

double total(const Frame& frame, FoundBy by) {
    double sum = 0;
    for (const Vec3& v : frame.strategies[size_t(by)]) sum += channel(v, 1);
    return sum;
}

// Largest difference between the sum of the planes and the beauty, over the larger of both.
double largest_difference(const Frame& frame) {
    double largest = 0;
    EXPECT_EQ(frame.strategies.size(), size_t(found_by_count));
    for (size_t i = 0; i < pixels; ++i)
        for (int c = 0; c < 3; ++c) {
            double sum = 0;
            for (const auto& plane : frame.strategies) {
                EXPECT_GE(channel(plane[i], c), 0);
                sum += channel(plane[i], c);
            }
            const double whole = double(frame.rgba[4 * i + size_t(c)]), larger = std::max(sum, whole);
            if (larger > 0) largest = std::max(largest, std::abs(sum - whole) / larger);
        }
    return largest;
}

// Every float is rounded once: by at most 2^-24 of itself, in planes and beauty; the rest is double precision.
constexpr double of_floats = 0x1.01p-23;
// Path reuse scales and sums up to 16 radiances in single precision, and that of each strategy on its own.
constexpr double of_reuse = 32 * 0x1p-24;

std::vector<std::string> all_scene_names() {
    std::vector<std::string> names = shipped_scene_names();
    names.insert(names.end(), caustic_scene_names().begin(), caustic_scene_names().end());
    return names;
}

TEST(StrategyPlanes, SumToTheBeauty) {
    for (const std::string& name : all_scene_names()) {
        SCOPED_TRACE(name);
        const Scene scene = shipped_scene(name);
        RenderSettings settings = settings_for(int(width), int(height), 8);
        settings.reuse = 1;
        EXPECT_LE(largest_difference(render_strategies(scene, settings)), of_floats);
        // Both halves, and the second half of an adaptive render by plan.
        settings.adaptive = true;
        settings.spp = 24;
        EXPECT_LE(largest_difference(render_strategies(scene, settings)), of_floats) << "adaptive";
        settings = settings_for(int(width), int(height), 8);
        settings.clamp = {0.5f, false};
        settings.reuse = 1;
        EXPECT_LE(largest_difference(render_strategies(scene, settings)), of_floats) << "clamped";
        settings.clamp.all = true;
        EXPECT_LE(largest_difference(render_strategies(scene, settings)), of_floats) << "all clamped";
    }
}

TEST(StrategyPlanes, SumToTheBeautyWithPathReuse) {
    for (const std::string& name : shipped_scene_names()) {
        RenderSettings settings = settings_for(int(width), int(height), 8);
        settings.reuse = 16;
        EXPECT_LE(largest_difference(render_strategies(shipped_scene(name), settings)), of_reuse) << name;
    }
}

TEST(StrategyPlanes, SumToTheBeautyWithLightPathsAndManifoldSampling) {
    bool splats = false, chains = false, vertices = false;
    for (const std::string& name : caustic_scene_names()) {
        RenderSettings settings = settings_for(int(width), int(height), 8);
        const CausticOptions all{.light_path_share = 1.f, .manifold_sampling = true, .light_vertices = true};
        const Frame frame = render_strategies(shipped_scene(name), settings, true, 2, all);
        EXPECT_LE(largest_difference(frame), of_floats) << name;
        splats = splats || total(frame, FoundBy::light_path) > 0;
        chains = chains || total(frame, FoundBy::manifold) > 0;
        vertices = vertices || total(frame, FoundBy::light_vertex) > 0;
        settings.clamp = {0.5f, false};
        EXPECT_LE(largest_difference(render_strategies(shipped_scene(name), settings, true, 2, all)), of_floats) << name << ", clamped";
    }
    EXPECT_TRUE(splats && chains && vertices);
}

// With one strategy alone, all light is in its plane, apart from emission in view.
TEST(StrategyPlanes, HoldWhatTheirStrategyFinds) {
    RenderSettings settings = settings_for(int(width), int(height), 8);
    settings.reuse = 1;
    settings.strategy = Strategy::bsdf;
    const Scene scene = shipped_scene("cornell");
    const Frame hits = render_strategies(scene, settings);
    EXPECT_GT(total(hits, FoundBy::camera_hit), 0);
    EXPECT_EQ(total(hits, FoundBy::nee), 0);
    settings.strategy = Strategy::light;
    const Frame lit = render_strategies(scene, settings);
    EXPECT_GT(total(lit, FoundBy::nee), 0);
    settings.max_bounces = 0;
    EXPECT_EQ(lit.strategies[size_t(FoundBy::camera_hit)], render_strategies(scene, settings).strategies[size_t(FoundBy::camera_hit)]);
    for (const Frame* frame : {&hits, &lit})
        for (const FoundBy by : {FoundBy::guided, FoundBy::manifold, FoundBy::light_vertex, FoundBy::light_path})
            EXPECT_EQ(total(*frame, by), 0);
}

TEST(StrategyPlanes, SeparateWhatPathGuidingFinds) {
    RenderSettings settings = settings_for(int(width), int(height), 32);
    settings.caustics = CausticStrategy::guiding;
    const Scene scene = shipped_scene("wine-glass");
    const Frame guided = render_strategies(scene, settings, true, 2);
    EXPECT_GT(total(guided, FoundBy::guided), 0);
    EXPECT_LE(largest_difference(guided), of_floats);
    settings.caustics = CausticStrategy::off;
    EXPECT_EQ(total(render_strategies(scene, settings, true, 2), FoundBy::guided), 0);
}

TEST(StrategyPlanes, DoNotChangeTheBeautyAndAreDeterministic) {
    for (const auto& [name, spp] : {std::pair{"cornell", 6}, {"pool", 4}, {"metal-ring", 4}}) {
        SCOPED_TRACE(name);
        const Scene scene = shipped_scene(name);
        const RenderSettings settings = settings_for(int(width), int(height), spp);
        const Frame without = render_strategies(scene, settings, false), with = render_strategies(scene, settings);
        EXPECT_TRUE(without.strategies.empty());
        EXPECT_EQ(without.rgba, with.rgba);
        EXPECT_EQ(render_strategies(scene, settings, true, 3).strategies, with.strategies) << "threads";
        for_each_isa([&](const std::string& isa) { EXPECT_EQ(render_strategies(scene, settings).strategies, with.strategies) << isa; });
    }
}

// Two films of a part of the samples each, merged.
TEST(StrategyPlanes, AreContinuedAndMerged) {
    const Scene scene = shipped_scene("metal-ring");
    const RenderSettings settings = settings_for(int(width), int(height), 8);
    const RendererOptions options{.threads = 2, .planes = {.strategies = true}, .caustics = {.light_path_share = 1.f}};
    Renderer whole(options), first(options), continued(options), second(options);
    for (Renderer* r : {&whole, &first, &continued, &second}) r->update(scene, settings);
    whole.render(0, 8);
    first.render(0, 4);
    const FilmState begun = *first.save_film(0);
    ASSERT_TRUE(continued.load_film(begun));
    continued.render(4, 4);
    EXPECT_EQ(continued.resolve().strategies, whole.resolve().strategies);
    second.render(4, 4);
    const Result<FilmState> merged = merge_films(begun, *second.save_film(4), settings);
    ASSERT_TRUE(merged);
    const Result<ResolvedFilm> resolved = resolve_film(*merged, settings, 2);
    ASSERT_TRUE(resolved);
    EXPECT_LE(largest_difference(resolved->frame), of_floats);
    EXPECT_GT(total(resolved->frame, FoundBy::light_path), 0);
}

} // namespace
} // namespace blush::test::TEST_FILE
