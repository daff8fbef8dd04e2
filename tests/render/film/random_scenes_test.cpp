// Random scenes with random settings give the same bits however they are rendered: in parts, by any threads and kernels, after edits.
#include "render/film/film_merger.h"
#include "render/film/film_state.h"
#include "scene/document/document.h"
#include "tests/render/random_scene.h"
#include "tests/render/rendered_image.h"
#include "tests/support/images.h"
#include "tests/support/random_edits.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <utility>

namespace blush::test::TEST_FILE {
namespace {

constexpr int samples = 20;

struct Case {
    Scene scene;
    RenderSettings settings;
    PlaneSet planes;
};

Case random_case(uint32_t seed) {
    RandomScene random(seed);
    random.enrich();
    random.harden();
    Case c{random.scene, random_unbiased_settings(seed), {.albedo = true, .normal = true, .depth = true, .ids = true}};
    std::mt19937 numbers(seed + 1);
    const auto one_in = [&](uint32_t n) { return numbers() % n == 0; };
    RenderSettings& s = c.settings;
    s.width = 40;
    s.height = 30;
    s.spp = samples;
    s.seed = seed;
    s.max_bounces = random.max_bounces;
    if (one_in(2)) s.filter = PixelFilter::blackman_harris;
    if (one_in(8)) s.strategy = Strategy::light;
    if (s.strategy != Strategy::mis) s.heuristic = {}, s.mis_compensation = false;
    if (one_in(5)) s.clamp = {.limit = 5, .all = one_in(2)};
    if (one_in(4)) s.energy_compensation = true;
    if (one_in(3)) c.planes.bounces = 4;
    if (one_in(3)) c.planes.strategies = true;
    if (one_in(3)) c.scene.mix.grouping = one_in(2) ? LightMix::Grouping::by_light : LightMix::Grouping::by_object;
    return c;
}

Frame image(const Case& c, unsigned threads, std::initializer_list<int64_t> ends) {
    return render_in_steps(c.scene, c.settings, {.threads = threads, .planes = c.planes}, ends);
}

// Samples [first, last), to be merged with others.
FilmState part(const Case& c, int first, int last) {
    Renderer renderer({.threads = 2, .planes = c.planes, .is_part = true});
    renderer.update(c.scene, c.settings);
    EXPECT_TRUE(renderer.render(first, last - first));
    return *renderer.save_film(first);
}

Frame continued_from(const Case& c, const FilmState& state) {
    Renderer renderer({.threads = 2, .planes = c.planes});
    renderer.update(c.scene, c.settings);
    EXPECT_TRUE(renderer.load_film(state));
    if (state.samples < samples) { EXPECT_TRUE(renderer.render(state.samples, samples - state.samples)); }
    return renderer.resolve();
}

FilmState saved_after(const Case& c, int64_t count) {
    Renderer renderer({.threads = 2, .planes = c.planes});
    renderer.update(c.scene, c.settings);
    EXPECT_TRUE(renderer.render(0, count));
    return *renderer.save_film(0);
}

void expect_crop(const Case& whole_case, const Frame& whole) {
    Case c = whole_case;
    c.settings.region = {0.25f, 0.3f, 0.5f, 0.5f};
    const PixelRect r = pixels_of(c.settings.region, 40, 30);
    const Frame crop = image(c, 2, {samples});
    for (int y = r.y0; y < r.y1; ++y)
        for (int x = r.x0; x < r.x1; ++x)
            for (size_t k = 0; k < 4; ++k)
                ASSERT_EQ(crop.rgba[4 * size_t(y * 40 + x) + k], whole.rgba[4 * size_t(y * 40 + x) + k]) << x << ' ' << y;
}

TEST(RandomScenes, GiveTheSameBitsHoweverTheyAreRendered) {
    for (uint32_t seed = 1; seed <= 12; ++seed) {
        const Case c = random_case(seed);
        SCOPED_TRACE(std::to_string(seed) + ": " + text_of(c.settings));
        const Frame whole = image(c, 1, {samples});
        EXPECT_EQ(whole.health.dropped(), 0);
        EXPECT_TRUE(same_pixels(whole, image(c, 3, {samples}))) << "threads";
        EXPECT_TRUE(same_pixels(whole, image(c, 2, {1, 2, 9, samples}))) << "steps";
        for_each_isa([&](const std::string& isa) { EXPECT_TRUE(same_pixels(whole, image(c, 2, {samples}))) << isa; });
        for (const int64_t count : {1, 7}) EXPECT_TRUE(same_pixels(whole, continued_from(c, saved_after(c, count)))) << "after " << count;
        if (c.settings.adaptive) continue; // regions are sampled evenly, and parts need its shares
        expect_crop(c, whole);
        FilmMerger merger(c.settings);
        for (const auto& [first, last] : {std::pair{0, 1}, {1, 6}, {6, samples}}) ASSERT_TRUE(merger.add(part(c, first, last)));
        EXPECT_TRUE(same_pixels(whole, continued_from(c, merger.sum()))) << "merged";
    }
}

TEST(RandomScenes, RenderAfterEditsLikeFreshScenes) {
    constexpr int64_t count = 3; // with what the pilots decided
    for (uint32_t seed = 1; seed <= 4; ++seed) {
        const Case c = random_case(seed);
        SCOPED_TRACE(std::to_string(seed) + ": " + text_of(c.settings));
        Document document(Project{c.scene, c.settings, {}});
        Rng rng(seed);
        const RendererOptions options{.threads = 2, .planes = c.planes};
        Renderer updated(options);
        Project base = document.project(); // that the film was rendered from
        updated.update(base.scene, base.render);
        ASSERT_TRUE(updated.render(0, count));
        for (int step = 0; step < 25; ++step) {
            const Edit edit = random_edit(rng, document.project());
            const std::string what = label(edit, document.project());
            ASSERT_TRUE(document.apply(edit)) << what;
            const Project& project = document.project();
            if (updated.update(project.scene, project.render)) {
                ASSERT_TRUE(updated.render(project.render.first_sample, count));
                base = project;
            }
            Renderer fresh(options);
            fresh.update(base.scene, base.render);
            ASSERT_TRUE(fresh.render(base.render.first_sample, count));
            EXPECT_FALSE(fresh.update(project.scene, project.render)) << what;
            ASSERT_TRUE(same_pixels(updated.resolve(), fresh.resolve())) << "step " << step << ": " << what;
        }
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
