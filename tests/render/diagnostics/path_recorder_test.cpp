// The sum over recorded paths is what the film holds of the pixel for these samples, and their parts sum to the paths.
#include "render/diagnostics/path_recorder.h"

#include "render/renderer.h"
#include "scene/affine.h"
#include "scene/reuse_setting.h"
#include "tests/render/integrator/manifold/lit_casters.h"
#include "tests/render/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

// Relative; the film and the frame hold a mean in single precision.
constexpr double rounding = 2e-6;

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance, const std::string& what) {
    const double scale = std::max({b.x, b.y, b.z, 1e-6});
    EXPECT_NEAR(a.x, b.x, tolerance * scale) << what;
    EXPECT_NEAR(a.y, b.y, tolerance * scale) << what;
    EXPECT_NEAR(a.z, b.z, tolerance * scale) << what;
}

// The recommended settings, without what the sum leaves out (not_replayed()).
RenderSettings settings_for(int width, int height, int64_t first, int64_t last) {
    RenderSettings s = recommended_settings();
    s.width = width;
    s.height = height;
    s.seed = 3;
    s.first_sample = first;
    s.spp = last;
    s.adaptive = false;
    s.reuse = 1;
    s.smooth_edges = false;
    return s;
}

struct Pixel {
    int x, y;
};

void expect_sum_of_the_film(const std::string& name, const Scene& scene, int64_t first, int64_t last) {
    constexpr int width = 32, height = 20;
    const RenderSettings settings = settings_for(width, height, first, last);
    Renderer renderer;
    renderer.update(scene, settings);
    ASSERT_TRUE(renderer.render(first, last - first));
    const Frame frame = renderer.resolve();
    PathRecorder recorder;
    recorder.update(scene, settings);
    ASSERT_TRUE(recorder.decide());
    EXPECT_TRUE(recorder.not_replayed().empty());
    for (const Pixel p : {Pixel{16, 10}, {6, 15}, {24, 8}}) {
        const auto paths = recorder.record(p.x, p.y, first, last - first, true);
        ASSERT_TRUE(paths);
        const PathSum sum = sum_of(*paths);
        const float* film = &frame.rgba[4 * (size_t(p.y) * width + size_t(p.x))];
        expect_near(sum.mean, {film[0], film[1], film[2]}, rounding, name);
        Vec3d found{0, 0, 0}, lengths = sum.light_paths;
        for (const Vec3d& part : sum.by_strategy) found = found + part;
        for (const Vec3d& part : sum.by_length) lengths = lengths + part;
        expect_near(found, sum.mean, rounding, name + " by strategy");
        expect_near(lengths, sum.mean, rounding, name + " by length");
    }
}

TEST(PathRecorder, SumsToTheFilm) {
    for (const std::string& name : shipped_scene_names()) expect_sum_of_the_film(name, shipped_scene(name), 0, 16);
    expect_sum_of_the_film("two-bounces", shipped_scene("two-bounces"), 5, 21);
}

// Light paths, manifold sampling and path guiding; the first sample is rendered as the pilots decide.
TEST(PathRecorder, SumsToTheFilmOnCaustics) {
    for (const char* name : {"pool", "bulb", "metal-ring"}) expect_sum_of_the_film(name, shipped_scene(name), 0, 5);
    expect_sum_of_the_film("pool with light vertices", deep_pool(), 0, 5);
}

// A single sample needs no pilots.
TEST(PathRecorder, RecordsTheFirstSampleWithoutPilots) {
    constexpr int width = 16, height = 12;
    const Scene scene = shipped_scene("bulb");
    const RenderSettings settings = settings_for(width, height, 0, 1);
    Renderer renderer;
    renderer.update(scene, settings);
    ASSERT_TRUE(renderer.render(0, 1));
    const Frame frame = renderer.resolve();
    PathRecorder recorder(1);
    recorder.update(scene, settings);
    for (int x = 0; x < width; ++x) {
        const float* film = &frame.rgba[4 * (size_t(6) * width + size_t(x))];
        expect_near(to_double(recorder.record(x, 6, 0).total()), {film[0], film[1], film[2]}, rounding, "bulb");
    }
    EXPECT_FALSE(recorder.decided());
}

// Throughput, factors, survival and weights of all vertices give the contributions.
TEST(PathRecorder, FactorsGiveTheThroughput) {
    int scattered = 0, survived = 0, died = 0, connected = 0, blocked = 0, delta = 0, hit = 0;
    for (const char* name : {"card-and-mug", "cornell", "corridor", "veach-mis", "wine-glass"}) {
        PathRecorder recorder;
        recorder.update(shipped_scene(name), settings_for(24, 18, 0, 48));
        const auto paths = recorder.record(12, 9, 0, 48, false);
        ASSERT_TRUE(paths);
        for (const RecordedPath& path : *paths) {
            const PathVertex* before = nullptr;
            Vec3d sum{0, 0, 0};
            for (const PathVertex& v : path.vertices) {
                const Vec3 carried = before ? before->beta : Vec3{1, 1, 1};
                expect_near(to_double(v.arriving), to_double(carried * v.passed), 1e-5, name);
                if (v.end == PathEnd::none || v.end == PathEnd::roulette)
                    expect_near(to_double(v.beta), to_double(v.arriving * v.factor / v.survival), 1e-4, name);
                if (v.emits && v.emission_mis > 0)
                    expect_near(to_double(v.emission), to_double(v.arriving * v.radiance * v.emission_mis), 1e-4, name);
                if (v.next_event) {
                    const NextEvent& e = *v.next_event;
                    expect_near(to_double(e.sent), to_double(v.arriving * e.f_cos * e.radiance * (e.mis / e.light_pdf)), 1e-4, name);
                    EXPECT_EQ(e.blocked, e.arrived == (Vec3{0, 0, 0}));
                    if (v.scatters == ScatterKind::diffuse) {
                        const Vec3d towards = normalize(e.to - e.from);
                        const double cosine = std::abs(dot(to_double(v.ns), towards));
                        expect_near(to_double(e.f_cos), to_double(v.color) * (cosine / std::numbers::pi), 1e-3, name);
                        // The table under the glass also samples directions into it.
                        if (std::string_view(name) != "wine-glass") expect_near(to_double(v.factor), to_double(v.color), 1e-5, name);
                    }
                    EXPECT_GT(dot(e.to - e.from, e.to - e.from), 0);
                    ++connected;
                    blocked += e.blocked && !e.blocker.empty();
                }
                scattered += v.end == PathEnd::none;
                survived += v.end == PathEnd::none && v.roulette && v.survival < 1;
                died += v.end == PathEnd::roulette;
                delta += std::isinf(v.pdf);
                hit += v.emits && max_component(v.emission) > 0;
                sum = sum + to_double(v.received());
                before = &v;
            }
            expect_near(sum, to_double(path.radiance), 1e-5, name);
            EXPECT_NE(path.vertices.back().end, PathEnd::none);
        }
    }
    for (const int seen : {scattered, survived, died, connected, blocked, delta, hit}) EXPECT_GT(seen, 5);
}

// A shelf between floor and lamp: its shadow ray ends at it.
TEST(PathRecorder, FindsWhatBlocksTheLight) {
    Scene scene;
    place(scene, floor_quad(4), lambert(0.5f));
    place(scene, floor_quad(1, 0.7f), lambert(0.5f));
    Light lamp;
    lamp.intensity = 100;
    place_light(scene, lamp, at({0, 2, 0}));
    const Id<Node> second = scene.nodes.entries()[1].id;
    Node shelf = *scene.nodes.find(second);
    shelf.name = "shelf";
    scene.nodes.set(second, shelf);
    scene.view = looking_down(0.5f, 0.2f);
    RenderSettings settings = settings_for(8, 8, 0, 4);
    settings.max_bounces = 1;
    PathRecorder recorder(1);
    recorder.update(scene, settings);
    const RecordedPath path = recorder.record(4, 4, 0);
    ASSERT_TRUE(path.vertices.front().next_event);
    const NextEvent& e = *path.vertices.front().next_event;
    EXPECT_TRUE(e.blocked);
    EXPECT_EQ(e.blocker, "shelf");
    EXPECT_NEAR(e.to.y, 0.7, 1e-4);
    EXPECT_GT(e.sent.x, 0);
}

TEST(PathRecorder, SaysWhatIsNotReplayed) {
    RenderSettings settings = settings_for(8, 8, 0, 2);
    settings.reuse = reuse_auto;
    settings.smooth_edges = true;
    settings.clamp.limit = 3;
    PathRecorder recorder(1);
    recorder.update(shipped_scene("cornell"), settings);
    const std::vector<std::string> notes = recorder.not_replayed();
    ASSERT_EQ(notes.size(), 3u);
    EXPECT_NE(notes[0].find("path reuse"), std::string::npos);
    EXPECT_NE(notes[1].find("smooth edges"), std::string::npos);
    EXPECT_NE(notes[2].find("clamping"), std::string::npos);
}

TEST(PathRecorder, CompilesOnlyWhatChanges) {
    const Scene scene = shipped_scene("cornell");
    RenderSettings settings = settings_for(8, 8, 0, 2);
    PathRecorder recorder(1);
    EXPECT_TRUE(recorder.update(scene, settings));
    EXPECT_FALSE(recorder.update(scene, settings));
    settings.spp = 77; // a stop rule
    EXPECT_FALSE(recorder.update(scene, settings));
    ASSERT_TRUE(recorder.decide());
    EXPECT_TRUE(recorder.decided());
    Scene turned = scene;
    turned.view.position.x += 0.1f;
    EXPECT_TRUE(recorder.update(turned, settings));
    EXPECT_FALSE(recorder.decided()); // pilots depend on the view
    const RecordedPath moved = recorder.record(4, 4, 0);
    PathRecorder fresh(1);
    fresh.update(turned, settings);
    EXPECT_EQ(moved.radiance, fresh.record(4, 4, 0).radiance);
}

} // namespace
} // namespace blush::test::TEST_FILE
