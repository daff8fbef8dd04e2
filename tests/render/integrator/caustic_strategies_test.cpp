// The strategies for caustics on the demo scenes: alone, all together and without they agree in the mean.
#include "scene/reuse_setting.h"
#include "tests/render/integrator/caustic_images.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

bool uses(const Scene& scene, const RenderSettings& settings, std::string_view feature) {
    Renderer renderer({.threads = 2});
    renderer.update(scene, settings);
    renderer.render(0, 2);
    return feature_line(renderer, feature).used;
}

std::vector<Measured> blocks_with(const Scene& scene, RenderSettings settings, CausticStrategy caustics, uint32_t first_seed) {
    settings.caustics = caustics;
    return image_blocks(scene, settings, {}, 16, first_seed, [](Renderer&) {});
}

TEST(CausticStrategies, AgreeOnTheDemoScenes) {
    for (const std::string& name : caustic_scene_names()) {
        SCOPED_TRACE(name);
        const Scene scene = with_wide_lights(name);
        RenderSettings settings = settings_for(48, 27, 512); // rare bright samples: many, so that means are normal
        const auto without = blocks_with(scene, settings, CausticStrategy::off, 1);
        settings.spp = 128;
        uint32_t seed = 1000;
        for (const CausticStrategy c :
             {CausticStrategy::automatic, CausticStrategy::guiding, CausticStrategy::light_paths, CausticStrategy::manifold})
            EXPECT_TRUE(same_means(blocks_with(scene, settings, c, seed += 1000), without)) << to_string(c);
    }
}

// As they are: what pilots choose, and that the setting excludes what it does not name.
TEST(CausticStrategies, AreChosenByPilotsWithinTheSetting) {
    const auto used = [](const char* name, CausticStrategy caustics) {
        RenderSettings settings = settings_for(160, 90, 2);
        settings.caustics = caustics;
        const Scene scene = shipped_scene(name);
        std::string features;
        for (const char* feature : {"path guiding", "light paths", "manifold sampling"})
            features += uses(scene, settings, feature) ? '1' : '0';
        return features;
    };
    EXPECT_EQ(used("pool", CausticStrategy::automatic)[0], '0') << "manifold sampling finds the light of path guiding";
    EXPECT_EQ(used("pool", CausticStrategy::automatic)[2], '1');
    EXPECT_EQ(used("pool", CausticStrategy::manifold), "001");
    EXPECT_EQ(used("metal-ring", CausticStrategy::automatic)[1], '1');
    EXPECT_EQ(used("metal-ring", CausticStrategy::light_paths), "010");
    EXPECT_EQ(used("prism", CausticStrategy::automatic), "011") << "both carry a wavelength";
    EXPECT_EQ(used("prism", CausticStrategy::manifold), "001");
    EXPECT_EQ(used("pool", CausticStrategy::guiding), "100");
    EXPECT_EQ(used("pool", CausticStrategy::off), "000");
    EXPECT_EQ(used("cornell", CausticStrategy::automatic), "000");
}

// Path reuse does not know the densities of light paths and manifold sampling. Where these are used, it is reported as left out, whether
// it is automatic or set to groups of 8 pixels.
TEST(CausticStrategies, SwitchPathReuseOffAndSaySo) {
    for (const int reuse : {reuse_auto, 8}) {
        RenderSettings settings = settings_for(160, 90, 2);
        settings.reuse = reuse;
        EXPECT_FALSE(uses(shipped_scene("pool"), settings, "path reuse"));
        EXPECT_FALSE(uses(shipped_scene("metal-ring"), settings, "path reuse"));
        EXPECT_TRUE(uses(shipped_scene("cornell"), settings, "path reuse"));
    }
    RenderSettings without = settings_for(160, 90, 2);
    without.reuse = 8;
    without.caustics = CausticStrategy::off;
    EXPECT_TRUE(uses(shipped_scene("pool"), without, "path reuse"));
}

} // namespace
} // namespace blush::test::TEST_FILE
