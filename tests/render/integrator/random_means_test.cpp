// Settings that change nothing about the mean of an image change nothing about it in random scenes.
#include "tests/render/integrator/caustic_images.h"
#include "tests/render/random_scene.h"

#include <cstdint>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

std::vector<Measured> blocks_of(const RandomScene& random, const RenderSettings& settings, uint32_t first_seed) {
    return image_blocks(random.scene, settings, {}, 24, first_seed,
                        [](Renderer& renderer) { EXPECT_EQ(renderer.resolve().health.dropped(), 0); });
}

TEST(RandomMeans, AreTheSameForAllSettings) {
    constexpr uint32_t scenes = 3, settings_per_scene = 3;
    const double alpha = sidak(significance, scenes * settings_per_scene);
    for (uint32_t seed = 1; seed <= scenes; ++seed) {
        RandomScene random(seed);
        random.enrich();
        RenderSettings plain = settings_for(36, 36, 64);
        plain.roulette.rule = Roulette::Rule::off;
        plain.caustics = CausticStrategy::off;
        plain.max_bounces = random.max_bounces == unlimited_bounces ? 12 : random.max_bounces;
        const auto expected = blocks_of(random, plain, 1);
        for (uint32_t k = 0; k < settings_per_scene; ++k) {
            RenderSettings settings = random_unbiased_settings(10 * seed + k);
            settings.width = settings.height = 36;
            settings.spp = 64;
            settings.max_bounces = plain.max_bounces;
            EXPECT_TRUE(same_means(blocks_of(random, settings, 1000 + 100 * k), expected, alpha)) << seed << ": " << text_of(settings);
        }
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
