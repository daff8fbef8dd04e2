// The shipped scenes match stored references: a z-test of each block of 8 x 8 pixels and of the whole image.
#include "core/math.h"
#include "tests/render/reference_scenes.h"

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr int block = 8;

// The corridor is lit through a gap: with the samples of its reference, the test would not even see 15 % less light.
RenderSettings test_settings(const std::string& scene) {
    RenderSettings settings = reference_settings(scene);
    if (scene == "corridor") settings.spp *= 16;
    return settings;
}

// The error of a single render is that of the reference times the square root of the number of renders, at the same number of samples; a
// render with more scatter uses its own error.
testing::AssertionResult looks_like(const RenderedImage& image, const Reference& reference, int64_t spp) {
    const double renders = reference.renders * double(reference_spp) / double(spp);
    std::vector<Measured> seen = image.blocks(block, block), expected = reference.mean.blocks(block, block);
    seen.push_back(image.whole());
    expected.push_back(reference.mean.whole());
    for (size_t i = 0; i < std::min(seen.size(), expected.size()); ++i) {
        const Vec3d usual = expected[i].error * std::sqrt(renders);
        Vec3d& e = seen[i].error;
        e = {std::max(e.x, usual.x), std::max(e.y, usual.y), std::max(e.z, usual.z)};
    }
    return same_means(seen, expected);
}

testing::AssertionResult matches_reference(const Scene& scene, const std::string& name, const RenderSettings& settings) {
    return looks_like(render(scene, settings), read_reference(reference_file(name)), settings.spp);
}
testing::AssertionResult matches_reference(const Scene& scene, const std::string& name) {
    return matches_reference(scene, name, test_settings(name));
}

TEST(References, ShippedScenesMatch) {
    for (const std::string& name : shipped_scene_names()) EXPECT_TRUE(matches_reference(shipped_scene(name), name)) << name;
}

Scene with_less_green(const Scene& scene, float factor) {
    Scene changed = scene;
    for (const auto& [id, material] : scene.materials) {
        Material m = material;
        m.base_color.y *= factor;
        changed.materials.set(id, m);
    }
    return changed;
}

Scene with_dimmer_light(const Scene& scene, float factor) {
    Scene changed = scene;
    for (const auto& [id, material] : scene.materials) {
        Material m = material;
        m.emissive_strength *= factor;
        changed.materials.set(id, m);
    }
    for (const auto& [id, light] : scene.lights) {
        Light l = light;
        l.intensity *= factor;
        changed.lights.set(id, l);
    }
    changed.environment.intensity *= factor;
    return changed;
}

// The test is sensitive in each scene: to light that is 5 % dimmer, and to surfaces that are 5 % less green.
TEST(References, SmallErrorsAreDetectedInEachScene) {
    for (const std::string& name : shipped_scene_names()) {
        const Scene scene = shipped_scene(name);
        EXPECT_FALSE(matches_reference(with_dimmer_light(scene, 0.95f), name)) << name << ": light";
        EXPECT_FALSE(matches_reference(with_less_green(scene, 0.95f), name)) << name << ": colour";
    }
}

TEST(References, CutPathsAreDetected) {
    RenderSettings shorter = test_settings("cornell");
    shorter.max_bounces = 4;
    EXPECT_FALSE(matches_reference(shipped_scene("cornell"), "cornell", shorter));
}

} // namespace
} // namespace blush::test::TEST_FILE
