// Light vertices beside manifold sampling: images with them agree in the mean with images without, whatever the densities that the weights
// are made of; a pilot decides about them; and every kernel has the same bits.
#include "tests/render/integrator/light_path_scenes.h"
#include "tests/render/integrator/manifold/chained_scene.h"
#include "tests/render/integrator/manifold/lit_casters.h"

#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

// Also with a point without size.
std::vector<std::pair<const char*, Scene>> chained_scenes() {
    auto scenes = walled_scenes();
    Scene by_point = scenes[0].second;
    place_light(by_point, caustic_light(Light::Kind::point, 20), at({0.1f, 2.2f, 0.5f}));
    scenes.emplace_back("triangles and a point", by_point);
    return scenes;
}

// Emission chances of the light vertices in `tables`, times a factor.
std::vector<float> scaled_chances(const SceneTables& tables, float factor) {
    const EmissionTables& emission = tables.light_vertices.emission;
    std::vector<float> chances(emission.chances, emission.chances + emission.lights * (emission.casters.count + 1));
    for (float& c : chances) c *= factor;
    return chances;
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
            const std::vector<float> chances = scaled_chances(tables, factor);
            tables.light_vertices.emission.chances = chances.data();
            EXPECT_TRUE(same_means(chained.quarters(tables, 32, seed += 1000), without)) << factor;
        }
        // Roulette before walks: at most and at least of them.
        for (const float ratio : {1e-6f, 1e6f})
            EXPECT_TRUE(same_means(chained.quarters(chained.with_vertices(ratio), 32, seed += 1000), without)) << ratio;
    }
}

// Paths that take themselves for rarer than they are have too much flux.
TEST(LightVertices, AWrongFluxIsCaught) {
    const ChainedScene chained(shipped_scene("pool"), settings_for(24, 24, 7));
    SceneTables tables = chained.with_vertices();
    const std::vector<float> chances = scaled_chances(tables, 1 / 1.5f);
    tables.light_vertices.emitter.chances = chances.data();
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
    auto scenes = chained_scenes();
    for (const auto& [name, scene] : lit_scenes()) scenes.emplace_back(name, light_path_scenes::with_leaves(scene, false));
    for (const auto& [name, scene] : scenes) {
        const ChainedScene chained(scene, settings_for(24, 24, 7));
        const auto radiance_of = [&](const SceneTables& tables, const Kernel& kernel) {
            const auto tile = chained.render(tables, kernel, 3);
            EXPECT_TRUE(tile->manifolds);
            EXPECT_EQ(bool(tile->light_vertices), !tables.light_vertices.empty());
            std::vector<double> radiance(tile->r.data, tile->r.data + ChainedScene::paths);
            radiance.insert(radiance.end(), tile->g.data, tile->g.data + ChainedScene::paths);
            return radiance;
        };
        std::vector<SceneTables> variants{chained.tables};
        if (!chained.tables.blends) variants.push_back(chained.with_vertices());
        for (const SceneTables& tables : variants) {
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
