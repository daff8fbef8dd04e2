// Light vertices beside manifold sampling: images with them agree in the mean with images without, whatever the densities that the weights
// are made of; a pilot decides about them; and every kernel has the same bits.
#include "render/integrator/light_path_emission.h"
#include "render/lights/manifold_seed_table.h"
#include "render/pilots/guiding_pilot.h"
#include "tests/render/integrator/manifold/lit_casters.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

// Walls that see the caustics on the floor.
std::vector<std::pair<const char*, Scene>> walled_scenes() {
    auto scenes = lit_scenes();
    for (auto& [name, scene] : scenes) {
        const auto wall = [&](const Vec3& center, const Vec3& size) {
            Transform t = at(center);
            t.scale = size;
            place(scene, cube(false), lambert({0.8f, 0.75f, 0.7f}), t);
        };
        wall({0, 0.8f, -1.6f}, {2, 0.8f, 0.1f});
        wall({-1.8f, 0.8f, 0}, {0.1f, 0.8f, 1.6f});
    }
    return scenes;
}

// A block of water of the size of the pool, whose top has waves that focus on the bottom. Its sides are in the walls.
GeometryPtr waves() {
    constexpr int n = 48;
    Geometry g;
    const auto height = [](double x, double z) { return 0.004 * (std::sin(18 * x + 8 * z) + std::sin(6 * x - 22 * z)); };
    const auto slope = [](double x, double z) {
        const double a = std::cos(18 * x + 8 * z), b = std::cos(6 * x - 22 * z);
        return Vec3{float(-0.004 * (18 * a + 6 * b)), 1, float(-0.004 * (8 * a - 22 * b))};
    };
    const auto add = [&](double x, double y, double z, const Vec3& normal) {
        g.positions.push_back({float(x), float(y), float(z)});
        g.normals.push_back(normalize(normal));
        return uint32_t(g.positions.size() - 1);
    };
    const auto quad = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
        for (const uint32_t i : {a, b, c, a, c, d}) g.indices.push_back(i);
    };
    const auto side_of = [](int i) { return -1.05 + 2.1 * i / n; };
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) add(side_of(i), height(side_of(i), side_of(j)), side_of(j), slope(side_of(i), side_of(j)));
    const auto top = [](int i, int j) { return uint32_t(i * (n + 1) + j); };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) quad(top(i, j), top(i, j + 1), top(i + 1, j + 1), top(i + 1, j));
    const auto bottom = [&](double x, double z) { return add(x, -1.05, z, {0, -1, 0}); };
    const uint32_t corners[4] = {bottom(-1.05, -1.05), bottom(1.05, -1.05), bottom(1.05, 1.05), bottom(-1.05, 1.05)};
    quad(corners[0], corners[1], corners[2], corners[3]);
    // Sides, from the edges of the top to the bottom.
    const auto strip = [&](const Vec3& normal, auto&& x, auto&& z) {
        for (int i = 0; i < n; ++i) {
            const double x0 = x(i), z0 = z(i), x1 = x(i + 1), z1 = z(i + 1);
            quad(add(x0, height(x0, z0), z0, normal), add(x1, height(x1, z1), z1, normal), add(x1, -1.05, z1, normal),
                 add(x0, -1.05, z0, normal));
        }
    };
    strip({0, 0, -1}, side_of, [](int) { return -1.05; });
    strip(
        {-1, 0, 0}, [](int) { return -1.05; }, [&](int i) { return side_of(n - i); });
    strip(
        {0, 0, 1}, [&](int i) { return side_of(n - i); }, [](int) { return 1.05; });
    strip(
        {1, 0, 0}, [](int) { return 1.05; }, side_of);
    return std::make_shared<const Geometry>(std::move(g));
}

// White walls and bottom under waves, and a sun of half a degree whose reflection the camera does not see.
Scene deep_pool() {
    Scene scene;
    const auto wall = [&](const Vec3& center, const Vec3& size) {
        Transform t = at(center);
        t.scale = size;
        place(scene, cube(false), lambert(0.8f), t);
    };
    wall({0, -1.1f, 0}, {1.1f, 0.1f, 1.1f});
    for (const float side : {-1.f, 1.f}) {
        wall({1.1f * side, -0.4f, 0}, {0.1f, 0.7f, 1.1f});
        wall({0, -0.4f, 1.1f * side}, {1.1f, 0.7f, 0.1f});
    }
    Material water = glass(0, 1.33f);
    place(scene, waves(), water);
    Light sun = caustic_light(Light::Kind::sun, 4);
    sun.angle_radians = 0.0087f;
    place_light(scene, sun, aimed({0, 5, 0}, {0.9f, -1, 0.2f}));
    scene.view = looking({0.3f, 3, 1.5f}, {0, -0.6f, 0}, 0.6f);
    return scene;
}

// A scene that is rendered by kernels, tile by tile, with manifold sampling.
class ChainedScene {
public:
    ChainedScene(const Scene& scene, const RenderSettings& settings) : settings_(settings) {
        compiled_.update(expand_area_lights(scene), settings, full_plan(), Workers(1));
        tables = compiled_.tables();
        std::vector<std::unique_ptr<TileScratch>> scratch(1);
        const auto photons =
            trace_caustic_photons(context(tables, 3), kernels_of("scalar").back(), Workers(1), scratch, [] { return true; });
        seeds_ = ManifoldSeedTable::make(photons->chains, tables, {}).value();
        EXPECT_FALSE(seeds_.empty());
        tables.manifolds = seeds_.tables(tables.guides.casters);
        emission = LightPathEmission(tables, compiled_.bounding_sphere(),
                                     [&](int32_t light) { return tables.manifolds.group_of_light[light] >= 0; });
        EXPECT_FALSE(emission.empty());
        tables.guides = {};
        usual_ratio = measured_ratio();
    }
    KernelContext context(const SceneTables& scene, uint32_t seed) const {
        return {&scene, &compiled_.accel(), kernel_settings(settings_, float(size), float(size)), seed};
    }
    SceneTables with_vertices() const { return with_vertices(usual_ratio); }
    SceneTables with_vertices(float ratio) const {
        SceneTables t = tables;
        t.light_vertices = {emission.tables(1), &emission, ratio, 0.1f};
        return t;
    }
    // Radiance of the samples of an image.
    std::unique_ptr<TileScratch> render(const SceneTables& scene, const Kernel& kernel, uint32_t seed) const {
        auto tile = std::make_unique<TileScratch>();
        Workers(1).run(
            [&] { kernel.render(context(scene, seed), {.x = 0, .y = 0, .width = size, .height = size, .samples = samples}, *tile); });
        return tile;
    }
    // Means of the quarters of images of different seeds.
    std::vector<Measured> quarters(const SceneTables& scene, int images, uint32_t first_seed) const {
        const Kernel& kernel = choose_kernel(compiled_.features().with(Feature::light_paths));
        BlockMoments moments;
        for (int k = 0; k < images; ++k) {
            const auto tile = render(scene, kernel, first_seed + uint32_t(k));
            std::vector<Measured> blocks(4);
            for (int slot = 0; slot < paths; ++slot) {
                const int pixel = slot / samples, x = pixel % size, y = pixel / size;
                Vec3d& mean = blocks[size_t(y / (size / 2) * 2 + x / (size / 2))].mean;
                mean = mean + Vec3d{tile->r[slot], tile->g[slot], tile->b[slot]} * (4.0 / paths);
            }
            moments.add(blocks);
        }
        return moments.measured();
    }

    static constexpr int size = 24, samples = 7, paths = size * size * samples;
    SceneTables tables;
    LightPathEmission emission;
    float usual_ratio = 0;

private:
    float measured_ratio() const {
        const auto tile = render(with_vertices(1), kernels_of("scalar").back(), 3);
        double sum = 0;
        int count = 0;
        for (int slot = 0; slot < paths; ++slot) {
            if (tile->light_vertices->chain[slot] == 0) continue;
            sum += std::log(double(tile->light_vertices->ratio[slot]));
            ++count;
        }
        EXPECT_GT(count, 0);
        return float(std::exp(sum / std::max(count, 1)));
    }

    RenderSettings settings_;
    RenderScene compiled_;
    ManifoldSeedTable seeds_;
};

TEST(LightVertices, AgreeWithTheOtherStrategies) {
    for (const auto& [name, scene] : walled_scenes()) {
        SCOPED_TRACE(name);
        RenderSettings settings = settings_for(36, 36, 48);
        const auto blocks = [&](float light_paths, bool manifolds, uint32_t seed) {
            return caustic_blocks(scene, settings,
                                  {.light_path_share = light_paths, .manifold_sampling = manifolds, .light_vertices = true},
                                  "light vertices", manifolds, 16, seed);
        };
        const auto without = blocks(0, false, 1);
        settings.spp = 24;
        EXPECT_TRUE(same_means(blocks(0, true, 1000), without));
        EXPECT_TRUE(same_means(blocks(0.5f, true, 2000), without)) << "with light paths";
    }
}

// Emission densities of the weights are wrong by factors; those of the light paths are not.
TEST(LightVertices, WeightsAddUpForAnyDensities) {
    for (const auto& [name, scene] : walled_scenes()) {
        SCOPED_TRACE(name);
        const ChainedScene chained(scene, settings_for(24, 24, 7));
        const auto without = chained.quarters(chained.tables, 32, 1);
        uint32_t seed = 1000;
        for (const float factor : {0.02f, 50.f}) {
            SceneTables tables = chained.with_vertices();
            std::vector<float> chances(tables.light_vertices.emission.chances,
                                       tables.light_vertices.emission.chances +
                                           tables.lights.count * (tables.light_vertices.emission.casters.count + 1));
            for (float& c : chances) c *= factor;
            tables.light_vertices.emission.chances = chances.data();
            EXPECT_TRUE(same_means(chained.quarters(tables, 32, seed += 1000), without)) << factor;
        }
        // Roulette before walks: at most and at least of them.
        for (const float ratio : {1e-6f, 1e6f})
            EXPECT_TRUE(same_means(chained.quarters(chained.with_vertices(ratio), 32, seed += 1000), without)) << ratio;
    }
}

// More flux than the lights have.
class TooBright final : public PathEmitter {
public:
    explicit TooBright(const PathEmitter& right) : right_(right) {}
    void emit_paths(const SceneTables& scene, const uint32_t* keys, const uint32_t* indices, int count,
                    std::vector<EmittedPath>& emitted) const override {
        right_.emit_paths(scene, keys, indices, count, emitted);
        for (EmittedPath& path : emitted) path.flux = path.flux * 1.5f;
    }

private:
    const PathEmitter& right_;
};

TEST(LightVertices, AWrongFluxIsCaught) {
    const ChainedScene chained(shipped_scene("pool"), settings_for(24, 24, 7));
    const TooBright wrong(chained.emission);
    SceneTables tables = chained.with_vertices();
    tables.light_vertices.emitter = &wrong;
    EXPECT_FALSE(same_means(chained.quarters(tables, 48, 1000), chained.quarters(chained.tables, 48, 1)));
}

// The pilot decides by variance and work: a pool under a small sun, seen from above, gains; the pool of the demo does not.
TEST(LightVertices, AreUsedWhereTheyPay) {
    const auto used = [](const Scene& scene, std::optional<bool> forced) {
        Renderer renderer({.threads = 2, .caustics = {.light_vertices = forced}});
        renderer.update(scene, settings_for(160, 90, 2));
        renderer.render(0, 2);
        EXPECT_TRUE(feature_line(renderer, "manifold sampling").used);
        return feature_line(renderer, "light vertices").used;
    };
    const Scene pool = shipped_scene("pool");
    EXPECT_TRUE(used(pool, true));
    EXPECT_FALSE(used(pool, false));
    EXPECT_FALSE(used(pool, {}));
    EXPECT_TRUE(used(deep_pool(), {}));
}

TEST(LightVertices, AreTheSameBitsFromEveryKernel) {
    for (const auto& [name, scene] : walled_scenes()) {
        const ChainedScene chained(scene, settings_for(24, 24, 7));
        const auto radiance_of = [&](const SceneTables& tables, const Kernel& kernel) {
            const auto tile = chained.render(tables, kernel, 3);
            EXPECT_TRUE(tile->manifolds);
            EXPECT_EQ(bool(tile->light_vertices), !tables.light_vertices.empty());
            std::vector<double> radiance(tile->r.data, tile->r.data + ChainedScene::paths);
            radiance.insert(radiance.end(), tile->g.data, tile->g.data + ChainedScene::paths);
            return radiance;
        };
        for (const SceneTables& tables : {chained.tables, chained.with_vertices()}) {
            SCOPED_TRACE(testing::Message() << name << (tables.light_vertices.empty() ? " without" : " with") << " light vertices");
            const std::vector<double> expected = radiance_of(tables, kernels_of("scalar").back());
            for (const std::string_view isa : runnable_isas())
                for (const Kernel& kernel : kernels_of(isa)) {
                    if (!kernel.trace_light_paths) continue;
                    EXPECT_EQ(radiance_of(tables, kernel), expected) << kernel.isa << "/" << kernel.name;
                }
        }
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
