// Light paths: the flux that they leave the lights with, their agreement in the mean with the other strategies, and that their sums do not
// depend on how they are rendered.
#include "render/integrator/light_path_emission.h"

#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/film/film_state.h"
#include "render/integrator/kernel_settings.h"
#include "render/integrator/light_path_weights.h"
#include "tests/render/integrator/light_path_scenes.h"
#include "tests/support/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;
using namespace light_path_scenes;

struct Compiled {
    RenderScene scene;
    explicit Compiled(const Scene& s, const RenderSettings& settings = settings_for(8, 8, 1)) {
        scene.update(expand_area_lights(s), settings, full_plan(), Workers(1));
    }
    LightPathEmission emission() const { return {scene.tables(), scene.bounding_sphere()}; }
};

// Mean flux of emitted paths, luminance: an estimate of that of all lights.
Moments emitted_flux(const Scene& scene) {
    const Compiled compiled(scene);
    const LightPathEmission emission = compiled.emission();
    EXPECT_FALSE(emission.empty());
    // Randomised, as points of one sequence are not independent.
    Moments flux;
    for (uint32_t k = 0; k < 64; ++k) {
        double sum = 0;
        constexpr uint32_t paths = 1024;
        for (uint32_t i = 0; i < paths; ++i)
            sum += double(luminance(emission.emit(compiled.scene.tables(), {pcg_hash(1000 + k), i}).flux)) / paths;
        flux.add(sum);
    }
    return flux;
}
// A caster; the floor keeps the scene's extent.
Scene one_ball() {
    Scene scene;
    place(scene, floor_quad(2), lambert(0.5f));
    place(scene, sphere(false), glass(0, 1.5f), at({0.5f, 0.5f, 0}, 0.4f));
    return scene;
}

TEST(LightPathEmission, CarriesTheFluxOfTheLights) {
    constexpr double pi_ = double(pi);
    Scene lamp = one_ball(); // 1 m2, one-sided
    place(lamp, ceiling_quad(0.5f, 2), emitter(7));
    EXPECT_TRUE(z_test(emitted_flux(lamp), pi_ * 7));
    Scene both = one_ball();
    Material sided = emitter(7);
    sided.double_sided = true;
    place(both, ceiling_quad(0.5f, 2), sided);
    EXPECT_TRUE(z_test(emitted_flux(both), 2 * pi_ * 7));
    Scene bulbs = one_ball(); // candela: flux 4 pi I, whatever the radius; the second is in the caster's sphere
    place_light(bulbs, caustic_light(Light::Kind::point, 5, 0.1f), at({0, 2, 0}));
    place_light(bulbs, caustic_light(Light::Kind::point, 3, 0.05f), at({0.5f, 0.5f, 0}));
    place_light(bulbs, caustic_light(Light::Kind::point, 2), at({-1, 1, 0})); // without size
    EXPECT_TRUE(z_test(emitted_flux(bulbs), 4 * pi_ * 10));
    Scene sunny = one_ball();
    Light sun = caustic_light(Light::Kind::sun, 3);
    sun.angle_radians = 0.1f;
    place_light(sunny, sun, aimed({0, 5, 0}, {0.3f, -1, 0.2f}));
    const double radius = double(Compiled(sunny).scene.bounding_sphere().radius);
    // Lux are those of a surface that faces the middle of the sun; each beam has its own cross-section.
    const double cosines = (1 + std::cos(0.05)) / 2;
    EXPECT_TRUE(z_test(emitted_flux(sunny), 3 / cosines * pi_ * radius * radius));
    Scene parallel = one_ball();
    place_light(parallel, caustic_light(Light::Kind::sun, 3), aimed({0, 5, 0}, {0.3f, -1, 0.2f}));
    EXPECT_TRUE(z_test(emitted_flux(parallel), 3 * pi_ * radius * radius));
}

// Directions of emitted paths. `density`: per solid angle.
testing::AssertionResult emission_follows(const Compiled& compiled, const auto& density) {
    const LightPathEmission emission = compiled.emission();
    uint32_t path = 0;
    const auto draw = [&]() -> std::optional<Vec3> {
        const EmittedPath e = emission.emit(compiled.scene.tables(), {pcg_hash(path++), 5});
        return e.density > 0 ? std::optional(e.direction) : std::nullopt;
    };
    return directions_follow({.rows = 24, .columns = 24, .points = 48}, draw, density);
}
// emission_density() per solid angle, at the middle of a light that is small beside its distance.
float density_at_center(const Compiled& compiled, const EmissionTables& tables, int32_t light, const Vec3& normal, const Vec3& away) {
    const LightRecord& record = compiled.scene.tables().lights.lights[light];
    const Vec3 center = record.position + (record.edge1 + record.edge2) * (1.f / 3);
    const auto p = emission_point<all_features, float>(compiled.scene.tables(), light, center, normal, -away, true);
    return emission_density<float>(tables, p, true) * std::abs(dot(normal, away)) / p.density;
}

TEST(LightPathEmission, OfTrianglesFollowsItsDensity) {
    for (const bool two_sided : {false, true}) {
        SCOPED_TRACE(two_sided);
        Scene scene = one_ball();
        place(scene, sphere(false), metal(0), at({-0.8f, 1.5f, 0.3f}, 0.3f));
        Material lamp = emitter(7);
        lamp.double_sided = two_sided;
        place(scene, ceiling_quad(1e-3f, 1.2f), lamp);
        const Compiled compiled(scene);
        const LightPathEmission emission = compiled.emission();
        const EmissionTables tables = emission.tables(1);
        ASSERT_EQ(compiled.scene.tables().lights.count, 2);
        EXPECT_TRUE(emission_follows(compiled, [&](const Vec3& away) {
            return density_at_center(compiled, tables, 0, {0, -1, 0}, away) + density_at_center(compiled, tables, 1, {0, -1, 0}, away);
        }));
    }
}

TEST(LightPathEmission, OfSpheresFollowsItsDensity) {
    Scene scene = one_ball();
    place(scene, sphere(false), metal(0), at({-0.8f, 1.5f, 0.3f}, 0.3f));
    place_light(scene, caustic_light(Light::Kind::point, 5, 1e-3f), at({0, 1.2f, 0}));
    place_light(scene, caustic_light(Light::Kind::point, 5), at({0.4f, 1.2f, 0})); // without size
    const Compiled compiled(scene);
    const LightPathEmission emission = compiled.emission();
    const EmissionTables tables = emission.tables(1);
    EXPECT_TRUE(emission_follows(compiled, [&](const Vec3& away) {
        double sum = 0;
        for (int32_t light = 0; light < compiled.scene.tables().lights.count; ++light) {
            if (LightKind(compiled.scene.tables().lights.lights[light].kind) == LightKind::point) {
                sum += double(density_at_center(compiled, tables, light, away, away));
                continue;
            }
            // At a cosine x it is c + e x, with c towards the casters and e over the hemisphere; the mean over all normals is c / 2 + e
            // / 4.
            const Vec3 tilted = normalize(basis_around(away).s * std::sqrt(0.75f) + away * 0.5f);
            const float facing = density_at_center(compiled, tables, light, away, away),
                        half = density_at_center(compiled, tables, light, tilted, away);
            const float even = 2 * (facing - half);
            sum += double((facing - even) / 2 + even / 4);
        }
        return float(sum);
    }));
}

TEST(LightPathEmission, OfSunsIsUniformOverTheirDisks) {
    Scene scene = one_ball();
    Light sun = caustic_light(Light::Kind::sun, 3);
    sun.angle_radians = 1.2f;
    place_light(scene, sun, aimed({0, 5, 0}, {0.3f, -1, 0.2f}));
    const Compiled compiled(scene);
    const Vec3 axis = normalize(Vec3{0.3f, -1, 0.2f});
    const float edge = std::cos(0.6f), pdf = 1 / (2 * pi * (1 - edge));
    EXPECT_TRUE(emission_follows(compiled, [&](const Vec3& away) { return dot(away, axis) > edge ? pdf : 0.f; }));
}

// Beams of a distant light: places across them, for one direction.
TEST(LightPathEmission, OfBeamsFollowsItsDensity) {
    Scene scene = one_ball();
    place(scene, sphere(false), metal(0), at({-0.8f, 1.5f, 0.3f}, 0.3f));
    Light sun = caustic_light(Light::Kind::sun, 3);
    sun.angle_radians = 1e-3f;
    place_light(scene, sun, aimed({0, 5, 0}, {0, -1, 0}));
    const Compiled compiled(scene);
    const LightPathEmission emission = compiled.emission();
    const EmissionTables tables = emission.tables(1);
    const Vec3 away{0, -1, 0}, center = compiled.scene.bounding_sphere().center;
    const float radius = compiled.scene.bounding_sphere().radius;
    constexpr int cells = 24, points = 48;
    constexpr int64_t samples = 100'000;
    std::vector<double> expected(cells * cells);
    for (int i = 0; i < cells * points; ++i)
        for (int k = 0; k < cells * points; ++k) {
            const auto along = [&](int n) { return (2 * (float(n) + 0.5f) / (cells * points) - 1) * radius; };
            const Vec3 position = center + Vec3{along(i), 0, along(k)};
            const auto p = emission_point<all_features, float>(compiled.scene.tables(), 0, position, {}, -away, true);
            const double area = 4 * double(radius) * double(radius) / (cells * points * cells * points);
            // Of the place alone: without the density of the direction.
            expected[size_t(i / points * cells + k / points)] +=
                double(emission_density<float>(tables, p, true) / p.density) * area * samples;
        }
    std::vector<int64_t> counts(expected.size());
    for (uint32_t path = 0; path < samples; ++path) {
        const EmittedPath e = emission.emit(compiled.scene.tables(), {pcg_hash(path), 5});
        const Vec3 off = e.origin + e.direction * (dot(center - e.origin, e.direction)) - center;
        const auto cell = [&](float x) { return size_t(std::clamp(int((x / radius + 1) / 2 * cells), 0, cells - 1)); };
        ++counts[cell(off.x) * cells + cell(off.z)];
    }
    EXPECT_TRUE(chi_squared_test(counts, expected));
}

TEST(LightPathEmission, OfTheEnvironmentFollowsItsDensity) {
    Scene scene = one_ball();
    std::vector<Vec3> texels;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x)
            texels.push_back(Vec3{1, 1, 1} * (0.2f + (x > 20 && y < 5 ? 6.f : 0.f) + 0.05f * float((x * 7 + y * 3) % 11)));
    scene.environment.kind = Environment::Kind::image;
    scene.environment.image = float_image(32, 16, texels);
    const Compiled compiled(scene);
    const SceneTables& tables = compiled.scene.tables();
    ASSERT_TRUE(tables.lights.samples_environment);
    EXPECT_TRUE(emission_follows(compiled, [&](const Vec3& away) { return environment_pdf<float>(tables.environment, -away); }));
}

std::vector<Measured> blocks_of(const Scene& scene, const RenderSettings& settings, float share, int images, uint32_t first_seed) {
    return caustic_blocks(scene, settings, {.light_path_share = share}, "light paths", share > 0, images, first_seed);
}

void agree_with_the_other_strategies(const std::vector<std::pair<const char*, Scene>>& scenes, int images = 20) {
    const double alpha = sidak(significance, int64_t(2 * scenes.size()));
    for (const auto& [name, scene] : scenes) {
        SCOPED_TRACE(name);
        RenderSettings settings = settings_for(36, 36, 16);
        const auto without = blocks_of(scene, settings, 0, images, 1);
        settings.spp = 4;
        EXPECT_TRUE(same_means(blocks_of(scene, settings, 2, images, 1000), without, alpha));
        settings.spp = 16;
        EXPECT_TRUE(same_means(blocks_of(scene, settings, 0.125f, images, 2000), without, alpha));
    }
}
TEST(LightPaths, AgreeWithTheOtherStrategies) { agree_with_the_other_strategies(lit_scenes()); }
TEST(LightPaths, AgreeThroughPanesAndBlendedSurfacesAndForLinkedLights) { agree_with_the_other_strategies(crossed_scenes()); }
TEST(LightPaths, AgreeForLightsWithOwnShadowCasters) { agree_with_the_other_strategies({{"own shadow casters", with_own_shadows()}}, 100); }

// Not even if the pilot has seen none of them: here the ball hides its caustic from the camera.
TEST(LightPaths, AreAlwaysUsedForLightsWithoutSize) {
    Scene scene;
    place(scene, sphere(false), metal(0), at({0, 0, 0}));
    place_light(scene, caustic_light(Light::Kind::point, 10), at({0, 3, 0}));
    scene.view = looking({0, 0, 5}, {0, 0, 0}, 0.2f);
    Renderer renderer({.caustics = {}});
    renderer.update(scene, settings_for(8, 8, 2));
    renderer.render(0, 2);
    const FeatureUse use = feature_line(renderer, "light paths");
    EXPECT_TRUE(use.used);
    EXPECT_EQ(use.why, "they alone find caustics of lights of zero size, with 0.125 for each camera path");
    EXPECT_FALSE(use.pilot) << "there is nothing to compare with";
}

// What panes reflect of lights without size is found by light paths; no surface samples directions towards them.
TEST(LightPaths, AreEmittedToPanesByLightsWithoutSize) {
    Scene room;
    place(room, floor_quad(2), lambert(0.5f));
    place(room, floor_quad(0.8f, 1.6f), window_glass());
    place(room, ceiling_quad(0.5f, 2.5f), emitter(10));
    EXPECT_EQ(Compiled(room).scene.tables().emission_casters.count, 0) << "rays hit the lamp";
    place_light(room, caustic_light(Light::Kind::point, 10), at({0, 1, 0}));
    const Compiled lit(room);
    EXPECT_EQ(lit.scene.tables().emission_casters.count, 1);
    EXPECT_EQ(lit.scene.tables().casters.count, 0);
    EXPECT_EQ(lit.scene.tables().guides.casters.count, 0);
}

// They add to the camera's samples, which are those without, bit for bit, with path reuse.
TEST(LightPaths, OfLightsWithoutSizeLeaveTheSamplesOfTheCameraAsTheyAre) {
    Scene room;
    place(room, cube(true), lambert({0.8f, 0.6f, 0.4f}));
    place(room, sphere(false), metal(0), at({-0.5f, -0.6f, -0.3f}, 0.3f));
    place_light(room, caustic_light(Light::Kind::point, 2), at({0.2f, 0.6f, 0.1f}));
    room.view = looking({0, 0, 0.9f}, {0.3f, -0.6f, -0.2f}, 0.6f); // without the ball
    const auto rendered = [&](CausticStrategy caustics, const std::vector<int64_t>& counts) {
        RenderSettings settings = settings_for(32, 32, 8);
        settings.caustics = caustics;
        settings.reuse = 4;
        PlaneSet planes;
        planes.strategies = true;
        Renderer renderer({.threads = 2, .planes = planes});
        renderer.update(room, settings);
        int64_t first = 0;
        for (const int64_t count : counts) {
            EXPECT_TRUE(renderer.render(first, count));
            first += count;
        }
        EXPECT_EQ(feature_line(renderer, "light paths").used, caustics != CausticStrategy::off);
        EXPECT_TRUE(feature_line(renderer, "path reuse").used);
        return renderer.resolve();
    };
    const Frame with = rendered(CausticStrategy::light_paths, {8}), without = rendered(CausticStrategy::off, {8});
    EXPECT_NE(with.rgba, without.rgba);
    for (const FoundBy found_by : {FoundBy::camera_hit, FoundBy::nee})
        EXPECT_EQ(with.strategies[size_t(found_by)], without.strategies[size_t(found_by)]);
    // The first sample is kept, and gets its light paths with the second.
    for (const std::vector<int64_t>& counts : std::vector<std::vector<int64_t>>{{1, 7}, {1, 1, 6}, {3, 5}})
        EXPECT_TRUE(same_pixels(rendered(CausticStrategy::light_paths, counts), with));
}

// Only delta lobes lead their light to casters: NEE, whose shadow rays meet other objects, finds the rest. Under the floor, where a ball
// casts no shadow, leaving it out changes nothing.
TEST(LightPaths, AgreeWithThoseOfLightsWithoutOwnShadowCasters) {
    for (const float radius : {0.f, 0.3f}) {
        const auto blocks = [&](bool own_casters, uint32_t first_seed) {
            Scene scene = balls(0);
            Light light = caustic_light(Light::Kind::point, 20, radius);
            const Id<Node> unseen = place(scene, sphere(false), lambert(0.5f), at({0, -1, 0}, 0.3f));
            if (own_casters) light.shadow_casters = {true, {unseen}};
            place_light(scene, light, at({0, 2, 0.5f}));
            return blocks_of(scene, settings_for(36, 36, 16), 1, 20, first_seed);
        };
        EXPECT_TRUE(same_means(blocks(true, 1000), blocks(false, 1))) << radius;
    }
}

TEST(LightPaths, AgreeForEveryCamera) {
    Scene scene = lit_scenes()[0].second;
    scene.view.lens.aperture_radius = 0.2f;
    scene.view.lens.focus_distance = 3;
    RenderSettings settings = settings_for(36, 36, 16);
    EXPECT_TRUE(same_means(blocks_of(scene, settings, 1, 20, 1000), blocks_of(scene, settings, 0, 20, 1))) << "thin lens";
    scene.view.lens.aperture_radius = 0;
    settings.filter = PixelFilter::blackman_harris;
    EXPECT_TRUE(same_means(blocks_of(scene, settings, 1, 20, 1000), blocks_of(scene, settings, 0, 20, 1))) << "filter";
    scene.view.lens.orthographic = true;
    scene.view.lens.ymag = 1.2f;
    EXPECT_TRUE(same_means(blocks_of(scene, settings, 1, 20, 1000), blocks_of(scene, settings, 0, 20, 1))) << "orthographic";
}

// Splats of one tile of light paths.
// `alone`: of lights without size (LightPathEmission::of_zero_size_lights).
std::vector<Splat> splats_of(const Scene& scene, const Kernel& kernel, bool alone) {
    const RenderSettings settings = settings_for(36, 36, 1);
    const Compiled compiled(scene, settings);
    const LightPathEmission emission =
        alone ? LightPathEmission::of_zero_size_lights(compiled.scene.tables(), compiled.scene.bounding_sphere()) : compiled.emission();
    SceneTables tables = compiled.scene.tables();
    tables.emission = emission.tables(36 * 36);
    const KernelContext context{&tables, &compiled.scene.accel(), kernel_settings(settings, 36, 36), 3};
    const auto scratch = std::make_unique<TileScratch>();
    Workers(1).run([&] { trace_light_path_tile(context, kernel, emission, {1, 4096, 0, 4096}, *scratch); });
    return scratch->light_paths->splats;
}

TEST(LightPaths, AreTheSameBitsFromEveryKernel) {
    auto scenes = lit_scenes();
    std::ranges::move(crossed_scenes(), std::back_inserter(scenes));
    const char* alone_name = "alone, of a point";
    Scene& smooth = scenes.emplace_back(alone_name, balls(0)).second;
    place_light(smooth, caustic_light(Light::Kind::point, 20), at({0.2f, 2, 0.5f}));
    for (const auto& [name, scene] : scenes) {
        SCOPED_TRACE(name);
        const bool alone = name == alone_name;
        const std::vector<Splat> expected = splats_of(scene, kernels_of("scalar").back(), alone);
        ASSERT_GT(expected.size(), 100u);
        const Features needed = Compiled(scene, settings_for(36, 36, 1)).scene.features();
        size_t compared = 0;
        for (const std::string_view isa : runnable_isas())
            for (const Kernel& kernel : kernels_of(isa)) {
                if (!kernel.trace_light_paths || !kernel.features.contains(needed)) continue;
                ++compared;
                const std::vector<Splat> splats = splats_of(scene, kernel, alone);
                ASSERT_EQ(splats.size(), expected.size()) << kernel.isa << "/" << kernel.name;
                EXPECT_EQ(std::memcmp(splats.data(), expected.data(), sizeof(Splat) * splats.size()), 0)
                    << kernel.isa << "/" << kernel.name;
            }
        EXPECT_GE(compared, runnable_isas().size());
    }
}

TEST(LightPaths, DoNotDependOnThreadsAndParts) {
    const Scene scene = lit_scenes()[0].second;
    for (const bool adaptive : {false, true}) {
        RenderSettings settings = settings_for(40, 30, 24);
        settings.adaptive = adaptive;
        const auto image = [&](unsigned threads, std::initializer_list<int64_t> counts) {
            Renderer renderer({.threads = threads, .caustics = {.light_path_share = 0.5f}});
            renderer.update(scene, settings);
            int64_t first = 0;
            for (const int64_t count : counts) {
                EXPECT_TRUE(renderer.render(first, count));
                first += count;
            }
            return renderer.resolve();
        };
        const Frame whole = image(1, {24});
        for (const Frame& other : {image(3, {24}), image(2, {1, 23}), image(2, {5, 11, 8})}) {
            EXPECT_TRUE(same_pixels(whole, other));
            EXPECT_EQ(whole.error.relmse, other.error.relmse);
            EXPECT_EQ(whole.rays.total(), other.rays.total());
        }
    }
}

TEST(LightPaths, GoOnFromSavedSamples) {
    const Scene scene = lit_scenes()[0].second;
    const RenderSettings settings = settings_for(40, 30, 8);
    Renderer begun({.threads = 2, .caustics = {.light_path_share = 0.5f}}),
        continued({.threads = 2, .caustics = {.light_path_share = 0.5f}});
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
