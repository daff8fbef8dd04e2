// Chains whose light manifold sampling shares with light paths: surfaces that see by glass what a caustic lights.
#include "render/integrator/light_path_emission.h"
#include "tests/render/integrator/manifold/chained_scene.h"
#include "tests/render/integrator/manifold/lit_casters.h"

#include <cstring>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

std::vector<std::pair<const char*, Scene>> shared_scenes() {
    auto walled = walled_scenes();
    std::vector<std::pair<const char*, Scene>> scenes;
    scenes.emplace_back("balls between walls, a lamp of triangles", std::move(walled[0].second));
    scenes.emplace_back("balls between walls, spheres", std::move(walled[2].second));
    scenes.emplace_back("balls between walls, a sun", std::move(walled[3].second));
    scenes.emplace_back("dry walls of a pool", dry_walls());
    add_walls(scenes.emplace_back("dispersive solids between walls", dispersive_solids()).second);
    scenes.emplace_back("dry walls of a pool, plastic", dry_walls(0.6f, rough_materials()[0].second));
    scenes.emplace_back("dry walls of a pool, metal", dry_walls(0.6f, rough_materials()[2].second));
    return scenes;
}

// Any number of light paths changes the weights, not the mean.
TEST(SharedChains, AgreeForAnyShareOfLightPaths) {
    const std::vector<float> shares = {0.03f, 0.5f, 4};
    const auto scenes = shared_scenes();
    const double significance_each = sidak(significance, int(shares.size() * scenes.size()));
    for (const auto& [name, scene] : scenes) {
        SCOPED_TRACE(name);
        const auto blocks = [&](float share, bool manifolds, int spp, uint32_t seed) {
            return image_regions(scene, settings_for(36, 36, spp),
                                 {.light_path_share = share, .manifold_sampling = manifolds, .shared_chains = true}, 16, seed, 6, 6,
                                 [&](Renderer& renderer) {
                                     EXPECT_EQ(feature_line(renderer, "manifold sampling").used, manifolds);
                                     EXPECT_EQ(feature_line(renderer, "shared chains").used, share > 0);
                                 });
        };
        const auto without = blocks(0, false, 96, 1);
        uint32_t seed = 1000;
        for (const float share : shares)
            EXPECT_TRUE(same_means(blocks(share, true, 24, seed += 1000), without, significance_each)) << share;
    }
}

// The pilot decides by variance and work: the pool of the demo gains, a metal ring on a floor does not.
TEST(SharedChains, AreUsedWhereTheyPay) {
    const auto used = [](const char* name, std::optional<bool> forced, int width = 160) {
        Renderer renderer({.threads = 2, .caustics = {.shared_chains = forced}});
        renderer.update(shipped_scene(name), settings_for(width, width * 9 / 16, 2));
        renderer.render(0, 2);
        EXPECT_TRUE(feature_line(renderer, "manifold sampling").used);
        EXPECT_TRUE(feature_line(renderer, "light paths").used);
        return feature_line(renderer, "shared chains").used;
    };
    EXPECT_TRUE(used("pool", {}));
    EXPECT_TRUE(used("pool", {}, 480)) << "depends on the number of light paths, not on that of pixels";
    EXPECT_FALSE(used("pool", false));
    EXPECT_FALSE(used("metal-ring", {}));
    EXPECT_TRUE(used("metal-ring", true));
}

// Splats of a tile of light paths.
std::vector<Splat> splats_of(const ChainedScene& scene, const SceneTables& tables, const Kernel& kernel) {
    const auto tile = std::make_unique<TileScratch>();
    const KernelContext context = scene.context(tables, 3);
    Workers(1).run([&] { trace_light_path_tile(context, kernel, scene.emission, {1, 4096, 0, 4096}, *tile); });
    return tile->light_paths->splats;
}

TEST(SharedChains, AreTheSameBitsFromEveryKernel) {
    for (const auto& [name, scene] : shared_scenes()) {
        SCOPED_TRACE(name);
        const ChainedScene chained(scene, settings_for(24, 24, 7));
        SceneTables tables = chained.tables;
        tables.emission = chained.emission.tables(4096);
        const auto radiance_of = [&](const Kernel& kernel) {
            const auto tile = chained.render(tables, kernel, 3);
            return std::vector<double>(tile->r.data, tile->r.data + ChainedScene::paths);
        };
        const Kernel& scalar = kernels_of("scalar").back();
        const std::vector<Splat> expected = splats_of(chained, tables, scalar);
        ASSERT_GT(expected.size(), 10u);
        const std::vector<double> radiance = radiance_of(scalar);
        for (const std::string_view isa : runnable_isas())
            for (const Kernel& kernel : kernels_of(isa)) {
                if (!kernel.trace_light_paths || !kernel.features.contains(chained.features())) continue;
                const std::vector<Splat> splats = splats_of(chained, tables, kernel);
                ASSERT_EQ(splats.size(), expected.size()) << kernel.isa << "/" << kernel.name;
                EXPECT_EQ(std::memcmp(splats.data(), expected.data(), sizeof(Splat) * splats.size()), 0)
                    << kernel.isa << "/" << kernel.name;
                EXPECT_EQ(radiance_of(kernel), radiance) << kernel.isa << "/" << kernel.name;
            }
    }
}

// Of lights without size, no path of the camera finds what walks miss, so light paths keep it all.
TEST(SharedChains, AreLeftToLightPathsForLightsWithoutSize) {
    RenderSettings settings = settings_for(36, 36, 24);
    const Scene scene = dry_walls(0);
    const auto blocks = [&](bool manifolds, uint32_t seed) {
        return image_regions(scene, settings, {.light_path_share = 8, .manifold_sampling = manifolds, .shared_chains = true}, 16, seed, 36,
                             6, [&](Renderer& renderer) { EXPECT_EQ(feature_line(renderer, "manifold sampling").used, manifolds); });
    };
    // The fourth row from below shows dry walls alone.
    const Measured shared = blocks(true, 1000)[3], alone = blocks(false, 1)[3];
    EXPECT_TRUE(same_means({&shared, 1}, {&alone, 1}));
}

} // namespace
} // namespace blush::test::TEST_FILE
