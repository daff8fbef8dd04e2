// The strategies for caustics agree in the mean in random scenes: features that meet in none of the other tests meet here.
#include "tests/render/integrator/caustic_images.h"
#include "tests/render/random_scene.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

RenderSettings settings_of(const RandomScene& random, int64_t spp) {
    RenderSettings settings = settings_for(36, 36, spp);
    settings.max_bounces = random.max_bounces;
    return settings;
}

constexpr CausticOptions everything{.light_path_share = 0.5f, .manifold_sampling = true, .light_vertices = true, .shared_chains = true};

void expect_sum_is_beauty(const std::vector<std::vector<Vec3>>& planes, const Frame& frame, uint32_t seed) {
    ASSERT_FALSE(planes.empty()) << seed;
    for (size_t i = 0; i < planes[0].size(); ++i) {
        double sum = 0;
        for (const auto& plane : planes) sum += double(plane[i].y);
        const double whole = double(frame.rgba[4 * i + 1]);
        // A ray that meets two suns, or sun and sky, adds both in single precision.
        ASSERT_NEAR(sum, whole, 0x1p-20 * std::max(sum, whole)) << "scene " << seed << ", pixel " << i;
    }
}

TEST(RandomCaustics, AgreeForAllStrategies) {
    constexpr std::array seeds{1u, 2u, 3u, 4u, 5u, 17u}; // 17: a lamp that is blended, which shadowed itself
    const double alpha = sidak(significance, int64_t(3 * seeds.size()));
    for (const uint32_t seed : seeds) {
        SCOPED_TRACE(seed);
        const RandomScene random(seed);
        const auto blocks = [&](const CausticOptions& strategies, uint32_t first_seed) {
            return image_blocks(random.scene, settings_of(random, 64), strategies, 24, first_seed, [](Renderer&) {});
        };
        const auto without = blocks({.light_path_share = 0.f, .manifold_sampling = false}, 1);
        EXPECT_TRUE(same_means(blocks({.light_path_share = 1.f, .manifold_sampling = false}, 1000), without, alpha)) << "light paths";
        EXPECT_TRUE(same_means(blocks({.light_path_share = 0.f, .manifold_sampling = true}, 2000), without, alpha)) << "manifold sampling";
        EXPECT_TRUE(same_means(blocks(everything, 3000), without, alpha)) << "all";
    }
}

// Each light is in one group, and each path has one length, whichever strategy finds it.
TEST(RandomCaustics, PlanesSumToTheBeauty) {
    for (uint32_t seed = 1; seed <= 40; ++seed) {
        RandomScene random(seed);
        const RenderSettings settings = settings_of(random, 6);
        for (const bool by_bounce : {false, true}) {
            random.scene.mix.grouping = by_bounce ? LightMix::Grouping::none : LightMix::Grouping::by_light;
            Renderer renderer({.threads = 2, .planes = {.bounces = by_bounce ? 6 : 0}, .caustics = everything});
            renderer.update(random.scene, settings);
            renderer.render(0, settings.spp);
            const Frame frame = renderer.resolve();
            expect_sum_is_beauty(by_bounce ? frame.bounces : frame.groups, frame, seed);
        }
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
