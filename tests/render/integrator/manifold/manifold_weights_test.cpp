// Wrong MIS weights of manifold sampling do not agree with the other strategies: the z-test that the tests beside this one rely on catches
// them. Of each pair of strategies that share light, one is weighted for another density of the solutions. It changes nothing but weights:
// no other strategy knows this density.
#include "render/integrator/manifold/manifold_receivers.h"
#include "tests/render/integrator/manifold/chained_scene.h"
#include "tests/render/integrator/manifold/lit_casters.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;
using Pixels = ChainedScene::Pixels;

// Tables of a scene with one group of lights, for weights alone: d is that of the scene times the factor, but for regions without seeds.
class WrongDensity {
public:
    WrongDensity(const SceneTables& right, float factor) : tables(right), group_(*right.manifolds.groups) {
        // The probability that a receiver selects the only group of lights, group_probability(), is part of d.
        group_.share = (factor - (1 - global_share)) / global_share;
        tables.manifolds.groups = &group_;
        for (int light = 0; light < tables.manifolds.lights; ++light) EXPECT_LE(tables.manifolds.group_of_light[light], 0) << "one group";
    }
    WrongDensity(const WrongDensity&) = delete;
    WrongDensity& operator=(const WrongDensity&) = delete;
    SceneTables tables;

private:
    ManifoldGroup group_;
};

Pixels operator+(Pixels a, const Pixels& b) {
    for (size_t i = 0; i < a.size(); ++i) a[i] = a[i] + b[i];
    return a;
}

// Light that these strategies find.
Pixels found_by(const ChainedScene& scene, const SceneTables& tables, uint32_t seed, std::initializer_list<FoundBy> strategies) {
    const auto tile = scene.render(tables, scene.fastest_kernel(), seed, true);
    Pixels pixels(size_t(ChainedScene::size) * ChainedScene::size);
    for (const FoundBy by : strategies) {
        const RadianceColumns& light = tile->strategies->light.all[size_t(by)];
        pixels = pixels + ChainedScene::pixels_of(light.r, light.g, light.b);
    }
    return pixels;
}

SceneTables without_manifolds(const ChainedScene& scene) {
    SceneTables tables = scene.tables;
    tables.manifolds = {};
    return tables;
}

// Light that is found behind mirrors and glass by these strategies, if there are no others. image(tables of the strategy that may be wrong,
// seed).
using FoundByPaths = std::initializer_list<FoundBy>;
constexpr FoundByPaths by_hits = {FoundBy::camera_hit, FoundBy::guided};
template <class Image>
void catches_wrong_densities(const ChainedScene& scene, const SceneTables& right, const Image& image, FoundByPaths by_paths = by_hits) {
    constexpr int images = 64;
    const SceneTables plain = without_manifolds(scene);
    const auto without = ChainedScene::quarters_of(images, 1, [&](uint32_t seed) { return found_by(scene, plain, seed, by_paths); });
    const auto weighted_for = [&](float factor, uint32_t first_seed) {
        const WrongDensity wrong(right, factor);
        return ChainedScene::quarters_of(images, first_seed, [&](uint32_t seed) { return image(wrong.tables, seed); });
    };
    const auto with = weighted_for(1, 1000);
    EXPECT_TRUE(same_means(with, without));
    // Not with `without`: paths rarely find a sun, so its mean is noisier.
    for (const float factor : {0.1f, 10.f}) EXPECT_FALSE(same_means(weighted_for(factor, 2000), with)) << factor;
}

void catches_wrong_hits(const Material& floor) {
    // A lamp so large that paths find much of its light.
    Scene balls = smooth_balls(floor);
    place(balls, ceiling_quad(1.8f, 2.5f), emitter(10));
    const ChainedScene scene(balls, settings_for(24, 24, 7));
    catches_wrong_densities(scene, scene.tables, [&](const SceneTables& tables, uint32_t seed) {
        return found_by(scene, scene.tables, seed, {FoundBy::manifold}) +
               found_by(scene, tables, seed, {FoundBy::camera_hit, FoundBy::guided});
    });
}
TEST(ManifoldWeights, OfHitsThatAreWrongAreCaught) { catches_wrong_hits(lambert({0.7f, 0.6f, 0.5f})); }
TEST(ManifoldWeights, OfHitsThatAreWrongAreCaughtOnRoughMetal) { catches_wrong_hits(metal(0.35f)); }

TEST(ManifoldWeights, OfLightVerticesThatAreWrongAreCaught) {
    const ChainedScene scene(deep_pool(0.6f), settings_for(24, 24, 7));
    const SceneTables right = scene.with_vertices();
    catches_wrong_densities(scene, right, [&](const SceneTables& tables, uint32_t seed) {
        return found_by(scene, right, seed, {FoundBy::manifold, FoundBy::camera_hit, FoundBy::guided}) +
               found_by(scene, tables, seed, {FoundBy::light_vertex});
    });
}

// On surfaces that are not Lambertian light paths share light with NEE, too.
void catches_wrong_light_paths(const Material& walls, FoundByPaths by_paths) {
    const ChainedScene scene(dry_walls(0.6f, walls), settings_for(24, 24, 7));
    constexpr int light_paths = 4 * ChainedScene::size * ChainedScene::size;
    SceneTables right = scene.tables;
    right.emission = scene.emission.tables(float(light_paths));
    catches_wrong_densities(
        scene, right,
        [&](const SceneTables& tables, uint32_t seed) {
            return found_by(scene, right, seed, {FoundBy::manifold}) + found_by(scene, right, seed, by_paths) +
                   scene.splats(tables, light_paths, seed);
        },
        by_paths);
}
TEST(ManifoldWeights, OfLightPathsThatAreWrongAreCaught) { catches_wrong_light_paths(lambert(0.8f), by_hits); }
TEST(ManifoldWeights, OfLightPathsThatAreWrongAreCaughtOnPlastic) {
    catches_wrong_light_paths(rough_materials()[0].second, {FoundBy::camera_hit, FoundBy::guided, FoundBy::nee});
}

} // namespace
} // namespace blush::test::TEST_FILE
