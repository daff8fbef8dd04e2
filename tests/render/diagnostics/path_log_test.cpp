// The log of a path matches the film: its contribution is what the film received for that sample.
#include "tests/render/integrator/manifold/lit_casters.h"
#include "tests/render/scenes.h"

#include "render/renderer.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

// The numbers in the last line.
bool read_radiance(const std::string& log, Vec3& radiance) {
    const size_t at = log.rfind("radiance (");
    return at != std::string::npos && std::sscanf(log.c_str() + at, "radiance (%f, %f, %f)", &radiance.x, &radiance.y, &radiance.z) == 3;
}

// `tolerance`: relative; six digits are printed.
void expect_radiance(const std::string& log, const float* film, float tolerance, const std::string& name) {
    Vec3 logged;
    ASSERT_TRUE(read_radiance(log, logged)) << log;
    EXPECT_NEAR(logged.x, film[0], tolerance * film[0]) << name << "\n" << log;
    EXPECT_NEAR(logged.y, film[1], tolerance * film[1]) << name << "\n" << log;
    EXPECT_NEAR(logged.z, film[2], tolerance * film[2]) << name << "\n" << log;
}

TEST(PathLog, MatchesTheRadianceThatTheFilmReceives) {
    constexpr int width = 16, height = 12;
    constexpr int64_t sample = 5;
    int lit = 0;
    for (const std::string& name : shipped_scene_names()) {
        const Scene scene = shipped_scene(name);
        RenderSettings settings;
        settings.width = width;
        settings.height = height;
        settings.seed = 7;
        Renderer renderer;
        renderer.update(scene, settings);
        ASSERT_TRUE(renderer.render(sample, 1));
        const Frame frame = renderer.resolve();
        for (const auto& [x, y] : {std::pair{8, 6}, {3, 9}, {12, 4}}) {
            const std::string log = trace_sample(scene, settings, x, y, sample);
            const float* film = &frame.rgba[4 * (size_t(y) * width + size_t(x))];
            expect_radiance(log, film, 5e-6f, name);
            lit += film[0] > 0 && log.find("MIS weight") != std::string::npos;
        }
    }
    EXPECT_GT(lit, 5);
}

// Light paths and manifold sampling are replayed, too.
TEST(PathLog, MatchesTheFilmOnCaustics) {
    constexpr int width = 32, height = 20;
    constexpr int64_t sample = 5;
    int by_light_paths = 0, by_chains = 0, by_vertices = 0;
    for (const std::string name : {"pool", "bulb", "metal-ring", "deep pool"}) {
        const bool vertices = name == "deep pool";
        const Scene scene = vertices ? deep_pool() : shipped_scene(name);
        RenderSettings settings;
        settings.width = width;
        settings.height = height;
        settings.seed = 7;
        Renderer renderer;
        renderer.update(scene, settings);
        ASSERT_TRUE(renderer.render(sample, 1));
        EXPECT_EQ(feature_line(renderer, "light vertices").used, vertices);
        const Frame frame = renderer.resolve();
        for (int k = 0; k < 12; ++k) {
            const int x = 3 + 7 * k % 26, y = 2 + 5 * k % 17;
            const std::string log = trace_sample(scene, settings, x, y, sample);
            const float* film = &frame.rgba[4 * (size_t(y) * width + size_t(x))];
            expect_radiance(log, film, 1e-5f, name);
            by_light_paths += log.find("  camera     receives") != std::string::npos;
            by_vertices += log.find("by light vertices") != std::string::npos;
            by_chains += log.find("by manifold sampling") != std::string::npos;
        }
    }
    EXPECT_GT(by_light_paths, 5);
    EXPECT_GT(by_chains, 3);
    EXPECT_GT(by_vertices, 0);
}

TEST(PathLog, SaysHowMuchLightBlendedSurfacesLeave) {
    Scene scene;
    place(scene, floor_quad(2), lambert(0.5f));
    Material veil = lambert(0.f);
    veil.alpha = Material::Alpha::blend;
    veil.opacity = 0.75f;
    place(scene, floor_quad(9, 1), veil);
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 4 * std::numbers::pi_v<float>;
    place_light(scene, sun, aimed({0, 3, 0}, {0, -1, 0}));
    scene.view = looking_down(1, 0.5f);
    RenderSettings settings;
    settings.width = settings.height = 8;
    settings.max_bounces = 1;
    const std::string log = trace_sample(scene, settings, 3, 4, 0);
    EXPECT_NE(log.find("contributes (2, 2, 2), dimmed to (0.5, 0.5, 0.5) over inf m"), std::string::npos) << log;
    Vec3 logged;
    ASSERT_TRUE(read_radiance(log, logged));
    EXPECT_NEAR(logged.x, 0.5f, 1e-6f);
}

// Every sample has it, whether the veil stops the path by chance or not.
TEST(PathLog, SaysHowMuchOfTheBackgroundBlendedSurfacesLeave) {
    Scene scene;
    constant_world(scene, 2);
    Material veil = lambert(0.f);
    veil.alpha = Material::Alpha::blend;
    veil.opacity = 0.75f;
    place(scene, floor_quad(9), veil);
    scene.view = looking_down(2, 0.5f);
    RenderSettings settings;
    settings.width = settings.height = 8;
    settings.max_bounces = 1;
    int stopped = 0;
    for (int64_t sample = 0; sample < 16; ++sample) {
        const std::string log = trace_sample(scene, settings, 3, 4, sample);
        const bool past = log.find("background contributes (0.5, 0.5, 0.5) past blended surfaces") != std::string::npos;
        EXPECT_NE(past, log.find("emission   contributes (0.5, 0.5, 0.5)") != std::string::npos) << log;
        stopped += past;
        Vec3 logged;
        ASSERT_TRUE(read_radiance(log, logged));
        EXPECT_NEAR(logged.x, 0.5f, 1e-6f);
    }
    EXPECT_EQ(stopped, 12);
}

TEST(PathLog, MentionsSmoothEdges) {
    RenderSettings settings;
    settings.width = settings.height = 16;
    EXPECT_EQ(trace_sample(shipped_scene("cornell"), settings, 9, 6, 2).find("smooth edges"), std::string::npos);
    settings.smooth_edges = true;
    EXPECT_NE(trace_sample(shipped_scene("cornell"), settings, 9, 6, 2).find("smooth edges"), std::string::npos);
}

TEST(PathLog, MentionsPathReuse) {
    const Scene scene = shipped_scene("cornell");
    RenderSettings settings;
    settings.width = settings.height = 16;
    const std::string alone = trace_sample(scene, settings, 9, 6, 2);
    settings.reuse = 16;
    const std::string shared = trace_sample(scene, settings, 9, 6, 2);
    EXPECT_EQ(alone.find("path reuse"), std::string::npos);
    EXPECT_NE(shared.find("among 16 pixels"), std::string::npos);
    Vec3 a, b;
    ASSERT_TRUE(read_radiance(alone, a) && read_radiance(shared, b));
    EXPECT_EQ(a, b);
}

TEST(PathLog, PrintsTheSurvivalProbability) {
    const Scene scene = shipped_scene("cornell");
    RenderSettings settings;
    settings.width = settings.height = 8;
    settings.roulette = {Roulette::Rule::constant, 1, 0, 1, 0.5f};
    int told = 0;
    for (int x = 0; x < 8; ++x) told += trace_sample(scene, settings, x, 4, 0).find("with probability 0.5") != std::string::npos;
    EXPECT_GT(told, 0);
}

} // namespace
} // namespace blush::test::TEST_FILE
