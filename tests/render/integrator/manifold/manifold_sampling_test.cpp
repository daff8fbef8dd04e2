// Manifold sampling: its agreement in the mean with the other strategies and with closed forms, and that images do not depend on how they
// are rendered. Every kernel: light_vertices_test.cpp.
#include "render/film/film_state.h"
#include "tests/render/integrator/light_path_scenes.h"
#include "tests/render/integrator/manifold/lit_casters.h"

#include <cmath>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

struct Strategies {
    float light_path_share;
    bool manifold_sampling;
};
std::vector<Measured> blocks_of(const Scene& scene, const RenderSettings& settings, const Strategies& strategies, int images,
                                uint32_t first_seed) {
    return caustic_blocks(scene, settings,
                          {.light_path_share = strategies.light_path_share, .manifold_sampling = strategies.manifold_sampling},
                          "manifold sampling", strategies.manifold_sampling, images, first_seed);
}

// Panes before, between and behind the balls: chains do not pass them.
Scene behind_panes() {
    Scene scene = smooth_balls();
    place(scene, ceiling_quad(0.7f, 2.5f), emitter(10));
    const Material pane = window_glass({0.9f, 0.6f, 0.8f});
    place(scene, floor_quad(0.4f, 1.4f), pane, at({0.4f, 0, 0}));
    place(scene, floor_quad(0.3f, 0.05f), pane, at({0.9f, 0, 0.2f}));
    place(scene, quad({-0.9f, 0.1f, 1}, {0.2f, 0.1f, 1}, {0.2f, 0.9f, 1}, {-0.9f, 0.9f, 1}), pane);
    return scene;
}

void agrees_with_the_other_strategies(const Scene& scene, int images) {
    RenderSettings settings = settings_for(36, 36, 48);
    const auto without = blocks_of(scene, settings, {0, false}, images, 1);
    settings.spp = 24;
    EXPECT_TRUE(same_means(blocks_of(scene, settings, {0, true}, images, 1000), without));
    EXPECT_TRUE(same_means(blocks_of(scene, settings, {0.5f, true}, images, 2000), without)) << "with light paths";
}
TEST(ManifoldSampling, AgreesWithTheOtherStrategies) {
    for (const auto& [name, scene] : lit_scenes()) {
        SCOPED_TRACE(name);
        agrees_with_the_other_strategies(scene, 16);
    }
}
TEST(ManifoldSampling, AgreesForDispersiveSolids) { agrees_with_the_other_strategies(dispersive_solids(), 32); }
TEST(ManifoldSampling, AgreesBehindPanes) { agrees_with_the_other_strategies(behind_panes(), 32); }
// Paths that pass a glowing pane straight keep all of its light.
TEST(ManifoldSampling, AgreesForPanesThatGlow) {
    Scene scene = smooth_balls();
    Light sun = caustic_light(Light::Kind::sun, 3);
    sun.angle_radians = 0.6f;
    place_light(scene, sun, aimed({0, 5, 0}, {0.3f, -1, 0.2f}));
    agrees_with_the_other_strategies(light_path_scenes::with_panes(scene), 24);
}

// Chains pass blended surfaces. Suns are seen past them: also several at once, of which one covers another.
TEST(ManifoldSampling, AgreesBehindBlendedSurfaces) {
    Scene lamp = smooth_balls(), suns = smooth_balls();
    place(lamp, ceiling_quad(0.7f, 2.5f), emitter(10));
    for (const float angle : {0.6f, 0.4f}) {
        Light sun = caustic_light(Light::Kind::sun, angle == 0.6f ? 3.f : 2.f);
        sun.angle_radians = angle;
        sun.color = {1, angle, 0.3f};
        place_light(suns, sun, aimed({0, 5, 0}, {0.3f, -1, 0.2f}));
    }
    // A ray that passes a pane begins again behind it, so such rays meet suns by chance.
    for (const auto& [name, scene] : {std::pair("lamp", light_path_scenes::with_leaves(lamp, false)),
                                      {"suns", light_path_scenes::with_leaves(suns, false)},
                                      {"panes", light_path_scenes::with_leaves(light_path_scenes::with_panes(suns), true)}}) {
        SCOPED_TRACE(name);
        agrees_with_the_other_strategies(scene, 24);
    }
}
// A path that meets such a lamp may begin its next chain there.
TEST(ManifoldSampling, AgreesForLampsThatReflectLight) {
    Scene scene = smooth_balls();
    place(scene, ceiling_quad(0.7f, 1.5f), emitter(10, 0.9f));
    agrees_with_the_other_strategies(scene, 24);
}
TEST(ManifoldSampling, AgreesWhereSunsCoverEachOther) {
    Scene scene = smooth_balls();
    for (const Vec3& color : {Vec3{1, 0.5f, 0.2f}, Vec3{0.2f, 0.5f, 1}}) {
        Light sun = caustic_light(Light::Kind::sun, 3);
        sun.angle_radians = 0.6f;
        sun.color = color;
        place_light(scene, sun, aimed({0, 5, 0}, {0.3f, -1, 0.2f}));
    }
    agrees_with_the_other_strategies(scene, 16);
}

// Lights without size: nothing finds them by chance. All light that the balls focus is in chains, as none of them is of glass.
TEST(ManifoldSampling, AgreesWithLightPathsAndLightVerticesForLightsWithoutSize) {
    Scene balls;
    place(balls, floor_quad(2), lambert({0.7f, 0.6f, 0.5f}));
    place(balls, quad({-2, 0, -1}, {2, 0, -1}, {2, 2, -1}, {-2, 2, -1}), lambert({0.5f, 0.6f, 0.7f}));
    place(balls, round_sphere(), metal(0), at({-0.7f, 0.5f, 0}, 0.4f));
    place(balls, round_sphere(), metal(0), at({0.7f, 0.5f, 0.2f}, 0.4f));
    balls.view = looking({0, 2.5f, 4}, {0, 0.3f, 0}, 0.6f);
    Scene by_point = balls, by_sun = balls;
    place_light(by_point, caustic_light(Light::Kind::point, 20), at({0.1f, 2.5f, 0.5f}));
    place_light(by_sun, caustic_light(Light::Kind::sun, 3), aimed({0, 5, 0}, {0.3f, -1, -0.2f}));
    for (const Scene& scene : {by_point, by_sun}) {
        const auto blocks = [&](float light_paths, bool vertices, uint32_t seed) {
            return caustic_blocks(scene, settings_for(36, 36, 24),
                                  {.light_path_share = light_paths, .manifold_sampling = true, .light_vertices = vertices},
                                  "light vertices", vertices, 16, seed);
        };
        const auto alone = blocks(0, false, 1);
        EXPECT_TRUE(same_means(blocks(0, true, 1000), alone, sidak(significance, 4))) << "with light vertices";
        EXPECT_TRUE(same_means(blocks(0.5f, true, 2000), alone, sidak(significance, 4))) << "with light paths, too";
    }
}

// A slab of glass over a floor, under a sun of half a degree or without size: of light from direction cosine c, (1 - F(c))^2 arrives on the
// floor by refraction alone. Paths end before it is reflected.
TEST(ManifoldSampling, FindsTheSunThroughASlab) {
    for (const auto& [ior, angle] : {std::pair(1.1f, 0.0087f), {1.5f, 0.0087f}, {2.4f, 0.0087f}, {1.5f, 0.f}}) {
        Scene scene;
        place(scene, floor_quad(3), lambert(0.5f));
        Transform slab = at({0, 1, 0});
        slab.scale = {20, 0.1f, 20};
        place(scene, cube(false), glass(0, ior), slab);
        Light sun = caustic_light(Light::Kind::sun, 4);
        sun.angle_radians = angle;
        const Vec3 direction = normalize(Vec3{0.6f, -0.8f, 0});
        place_light(scene, sun, aimed({0, 5, 0}, direction));
        scene.view = looking({0, 0.5f, 0.8f}, {0, 0, 0}, 0.6f);
        RenderSettings settings = settings_for(24, 24, 16);
        settings.max_bounces = 3;
        Renderer renderer({.threads = 2, .caustics = {.light_path_share = 0.f, .manifold_sampling = true}});
        renderer.update(scene, settings);
        renderer.render(0, settings.spp);
        ASSERT_TRUE(feature_line(renderer, "manifold sampling").used);
        const double c = 0.8, g = std::sqrt(double(ior) * double(ior) - 1 + c * c);
        const double s = (c - g) / (c + g), p = (double(ior) * double(ior) * c - g) / (double(ior) * double(ior) * c + g);
        const double passed = 1 - (s * s + p * p) / 2;
        // The Fresnel term over the sun's disk varies by less than the slack.
        const double expected = 0.5 / double(pi) * 4 * c * passed * passed;
        EXPECT_TRUE(is_mean(image_of(renderer).whole(), expected, significance, 1e-4 * expected)) << ior << ", angle " << angle;
    }
}

// A prism with a right angle over a floor. Sunlight from just below the horizon enters its upright face, is reflected totally by the slope
// and leaves by the lower face: (1 - F)^2 of it arrives at the floor, by this chain alone. Paths end before others.
TEST(ManifoldSampling, FindsTheSunByTotalReflection) {
    constexpr double ior = 1.5, below = 2 * double(pi) / 180; // the sun's angle, and that to both normals
    Scene scene;
    place(scene, floor_quad(3), lambert(0.5f));
    Geometry body;
    for (const float z : {-6.f, 6.f})
        for (const Vec3& p : {Vec3{-5, 1, z}, Vec3{5, 1, z}, Vec3{-5, 11, z}}) body.positions.push_back(p);
    // Counter-clockwise seen from outside; the corners of an end are so seen from +z.
    body.indices = {0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5};
    place(scene, std::make_shared<const Geometry>(std::move(body)), glass(0, float(ior)));
    Light sun = caustic_light(Light::Kind::sun, 4);
    sun.angle_radians = 0.0087f;
    place_light(scene, sun, aimed({0, 5, 0}, to_float(Vec3d{std::cos(below), std::sin(below), 0})));
    scene.view = looking({0, 0.5f, 0.8f}, {0, 0, 0}, 0.6f);
    RenderSettings settings = settings_for(24, 24, 16);
    settings.max_bounces = 4;
    Renderer renderer({.threads = 2, .caustics = {.light_path_share = 0.f, .manifold_sampling = true}});
    renderer.update(scene, settings);
    renderer.render(0, settings.spp);
    ASSERT_TRUE(feature_line(renderer, "manifold sampling").used);
    const double c = std::cos(below), g = std::sqrt(ior * ior - 1 + c * c);
    const double s = (c - g) / (c + g), p = (ior * ior * c - g) / (ior * ior * c + g), passed = 1 - (s * s + p * p) / 2;
    // The Fresnel term and the cosine over the sun's disk vary by less than the slack.
    const double expected = 0.5 / double(pi) * 4 * c * passed * passed;
    EXPECT_TRUE(is_mean(image_of(renderer).whole(), expected, significance, 2e-4 * expected));
}

TEST(ManifoldSampling, DoesNotDependOnThreadsAndParts) {
    const Scene scene = walled_scenes()[0].second;
    for (const float share : {0.f, 0.5f}) {
        const RenderSettings settings = settings_for(40, 30, 12);
        const auto image = [&](unsigned threads, std::initializer_list<int64_t> counts) {
            Renderer renderer(
                {.threads = threads, .caustics = {.light_path_share = share, .manifold_sampling = true, .light_vertices = true}});
            renderer.update(scene, settings);
            int64_t first = 0;
            for (const int64_t count : counts) {
                EXPECT_TRUE(renderer.render(first, count));
                first += count;
            }
            return renderer.resolve();
        };
        const Frame whole = image(1, {12});
        for (const Frame& other : {image(3, {12}), image(2, {1, 11}), image(2, {5, 7})}) {
            EXPECT_TRUE(same_pixels(whole, other));
            EXPECT_EQ(whole.rays.total(), other.rays.total());
        }
    }
}

TEST(ManifoldSampling, GoesOnFromSavedSamples) {
    const Scene scene = walled_scenes()[0].second;
    const RenderSettings settings = settings_for(40, 30, 8);
    const RendererOptions options{.threads = 2, .caustics = {.light_path_share = 0.f, .manifold_sampling = true, .light_vertices = true}};
    Renderer begun(options), continued(options);
    for (Renderer* renderer : {&begun, &continued}) renderer->update(scene, settings);
    EXPECT_TRUE(begun.render(0, 3));
    const Result<FilmState> state = begun.save_film(0);
    ASSERT_TRUE(state);
    EXPECT_TRUE(begun.render(3, 5));
    ASSERT_TRUE(continued.load_film(*state));
    EXPECT_TRUE(continued.render(3, 5));
    EXPECT_TRUE(same_pixels(begun.resolve(), continued.resolve()));
}

} // namespace
} // namespace blush::test::TEST_FILE
