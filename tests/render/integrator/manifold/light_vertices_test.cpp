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
        tables.manifolds = seeds_.tables(tables.casters);
        emission = LightPathEmission(tables, compiled_.bounding_sphere(),
                                     [&](int32_t light) { return tables.manifolds.group_of_light[light] >= 0; });
        EXPECT_FALSE(emission.empty());
        tables.guides = {};
        usual_ratio = measured_ratio();
    }
    KernelContext context(const SceneTables& scene, uint32_t seed) const {
        return {&scene, &compiled_.accel(), kernel_settings(settings_, float(size), float(size)), seed};
    }
    Features features() const { return compiled_.features(); }
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

// Also with a point without size.
std::vector<std::pair<const char*, Scene>> chained_scenes() {
    auto scenes = walled_scenes();
    Scene by_point = scenes[0].second;
    place_light(by_point, caustic_light(Light::Kind::point, 20), at({0.1f, 2.2f, 0.5f}));
    scenes.emplace_back("triangles and a point", by_point);
    return scenes;
}

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
    for (const auto& [name, scene] : chained_scenes()) {
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
    for (const auto& [name, scene] : chained_scenes()) {
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
                    if (!kernel.trace_light_paths || !kernel.features.contains(chained.features())) continue;
                    EXPECT_EQ(radiance_of(tables, kernel), expected) << kernel.isa << "/" << kernel.name;
                }
        }
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
