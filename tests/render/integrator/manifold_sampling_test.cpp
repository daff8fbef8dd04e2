// Manifold sampling: its agreement in the mean with the other strategies and with closed forms, and that images do not depend on how they
// are rendered.
#include "render/film/film_state.h"
#include "render/lights/manifold_seed_table.h"
#include "render/pilots/guiding_pilot.h"
#include "tests/render/integrator/caustic_images.h"

#include <cmath>
#include <initializer_list>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

// With interpolated normals, and so fine that they hardly differ from those of the triangles.
GeometryPtr round_sphere() {
    constexpr int rows = 48, columns = 96;
    Geometry g;
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double theta = std::numbers::pi * i / rows, phi = 2 * std::numbers::pi * j / columns;
            const Vec3 p{float(std::sin(theta) * std::cos(phi)), float(std::cos(theta)), float(std::sin(theta) * std::sin(phi))};
            g.positions.push_back(p);
            g.normals.push_back(p);
        }
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const int right = (j + 1) % columns, above = i * columns, below = above + columns;
            if (i > 0)
                for (const int k : {above + j, above + right, below + right}) g.indices.push_back(uint32_t(k));
            if (i + 1 < rows)
                for (const int k : {above + j, below + right, below + j}) g.indices.push_back(uint32_t(k));
        }
    return std::make_shared<const Geometry>(std::move(g));
}

// Smooth casters of caustics over a floor: a metal and a glass ball.
Scene smooth_balls() {
    Scene scene;
    place(scene, floor_quad(2), lambert({0.7f, 0.6f, 0.5f}));
    place(scene, round_sphere(), metal(0), at({-0.7f, 0.5f, 0}, 0.4f));
    place(scene, round_sphere(), glass(0, 1.5f), at({0.7f, 0.5f, 0.2f}, 0.4f));
    scene.view = looking({0, 2.5f, 4}, {0, 0.3f, 0}, 0.6f);
    return scene;
}
// Lights so large that paths find them by chance.
std::vector<std::pair<const char*, Scene>> lit_scenes() {
    std::vector<std::pair<const char*, Scene>> scenes;
    const auto add = [&](const char* name, const auto& light) { light(scenes.emplace_back(name, smooth_balls()).second); };
    add("triangles", [](Scene& s) { place(s, ceiling_quad(0.7f, 2.5f), emitter(10)); });
    add("two-sided triangles", [](Scene& s) {
        Material lamp = emitter(10);
        lamp.double_sided = true;
        place(s, ceiling_quad(0.7f, 2.5f), lamp);
        place(s, ceiling_quad(2, 4), lambert(0.8f));
    });
    add("spheres of unequal power", [](Scene& s) {
        place_light(s, caustic_light(Light::Kind::point, 20, 0.5f), at({0, 2.5f, 0.5f}));
        place_light(s, caustic_light(Light::Kind::point, 3, 0.5f), at({-1.5f, 2, 0}));
    });
    add("sun", [](Scene& s) {
        Light sun = caustic_light(Light::Kind::sun, 3);
        sun.angle_radians = 0.6f;
        place_light(s, sun, aimed({0, 5, 0}, {0.3f, -1, 0.2f}));
    });
    add("flat and stretched casters, absorption", [](Scene& s) {
        Material green = glass(0, 1.3f);
        green.attenuation_color = {0.3f, 0.9f, 0.5f};
        green.attenuation_distance = 0.5f;
        place(s, cube(false), green, at({0, 0.4f, 0.9f}, 0.25f));
        Transform wide = at({0, 1.2f, -0.5f}, 0.3f);
        wide.scale = {0.5f, 0.15f, 0.3f};
        place(s, round_sphere(), glass(0, 1.5f), wide);
        place(s, ceiling_quad(0.7f, 2.5f), emitter(10));
    });
    return scenes;
}

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

TEST(ManifoldSampling, AgreesWithTheOtherStrategies) {
    for (const auto& [name, scene] : lit_scenes()) {
        SCOPED_TRACE(name);
        RenderSettings settings = settings_for(36, 36, 48);
        const auto without = blocks_of(scene, settings, {0, false}, 16, 1);
        settings.spp = 24;
        EXPECT_TRUE(same_means(blocks_of(scene, settings, {0, true}, 16, 1000), without));
        EXPECT_TRUE(same_means(blocks_of(scene, settings, {0.5f, true}, 16, 2000), without)) << "with light paths";
    }
}

// A slab of glass over a floor, under a sun of half a degree: of light from direction cosine c, (1 - F(c))^2 arrives on the floor by
// refraction alone. Paths end before it is reflected.
TEST(ManifoldSampling, FindsTheSunThroughASlab) {
    for (const float ior : {1.1f, 1.5f, 2.4f}) {
        Scene scene;
        place(scene, floor_quad(3), lambert(0.5f));
        Transform slab = at({0, 1, 0});
        slab.scale = {20, 0.1f, 20};
        place(scene, cube(false), glass(0, ior), slab);
        Light sun = caustic_light(Light::Kind::sun, 4);
        sun.angle_radians = 0.0087f;
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
        EXPECT_TRUE(is_mean(image_of(renderer).whole(), expected, significance, 1e-4 * expected)) << ior;
    }
}

TEST(ManifoldSampling, IsTheSameBitsFromEveryKernel) {
    for (const auto& [name, scene] : lit_scenes()) {
        SCOPED_TRACE(name);
        const RenderSettings settings = settings_for(16, 16, 8);
        RenderScene compiled;
        compiled.update(expand_area_lights(scene), settings, full_plan(), Workers(1));
        SceneTables tables = compiled.tables();
        const KernelContext context{&tables, &compiled.accel(), kernel_settings(settings, 16, 16), 3};
        std::vector<std::unique_ptr<TileScratch>> scratch(1);
        const auto photons = trace_caustic_photons(context, kernels_of("scalar").back(), Workers(1), scratch, [] { return true; });
        const ManifoldSeedTable seeds = ManifoldSeedTable::make(photons->chains, tables, {}).value();
        ASSERT_FALSE(seeds.empty());
        tables.manifolds = seeds.tables(tables.guides.casters);
        tables.guides = {};
        const auto radiance_of = [&](const Kernel& kernel) {
            auto tile = std::make_unique<TileScratch>();
            Workers(1).run([&] { kernel.render(context, {.x = 0, .y = 0, .width = 16, .height = 16, .samples = 8}, *tile); });
            EXPECT_TRUE(tile->manifolds);
            std::vector<double> radiance(tile->r.data, tile->r.data + 16 * 16 * 8);
            radiance.insert(radiance.end(), tile->g.data, tile->g.data + 16 * 16 * 8);
            return radiance;
        };
        const std::vector<double> expected = radiance_of(kernels_of("scalar").back());
        for (const std::string_view isa : runnable_isas())
            for (const Kernel& kernel : kernels_of(isa)) {
                if (!kernel.trace_light_paths) continue;
                EXPECT_EQ(radiance_of(kernel), expected) << kernel.isa << "/" << kernel.name;
            }
    }
}

TEST(ManifoldSampling, DoesNotDependOnThreadsAndParts) {
    const Scene scene = lit_scenes()[0].second;
    for (const float share : {0.f, 0.5f}) {
        const RenderSettings settings = settings_for(40, 30, 12);
        const auto image = [&](unsigned threads, std::initializer_list<int64_t> counts) {
            Renderer renderer({.threads = threads, .caustics = {.light_path_share = share, .manifold_sampling = true}});
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
    const Scene scene = lit_scenes()[0].second;
    const RenderSettings settings = settings_for(40, 30, 8);
    const RendererOptions options{.threads = 2, .caustics = {.light_path_share = 0.f, .manifold_sampling = true}};
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
