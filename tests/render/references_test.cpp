// The shipped scenes match stored references: a z-test of each block of 8 x 8 pixels.
#include "core/math.h"
#include "tests/render/reference_scenes.h"

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr int block = 8;

// The error of a single render is that of the reference times the square root of the number of renders; a render with more
// scatter uses its own error.
testing::AssertionResult looks_like(const Picture& picture, const Reference& reference) {
    std::vector<Measured> seen = picture.blocks(block, block);
    const std::vector<Measured> expected = reference.mean.blocks(block, block);
    for (size_t i = 0; i < std::min(seen.size(), expected.size()); ++i) {
        const Vec3d usual = expected[i].error * std::sqrt(reference.renders);
        Vec3d& e = seen[i].error;
        e = {std::max(e.x, usual.x), std::max(e.y, usual.y), std::max(e.z, usual.z)};
    }
    return same_means(seen, expected);
}

TEST(References, ShippedScenesMatch) {
    for (const std::string& name : shipped_scene_names())
        EXPECT_TRUE(looks_like(render(shipped_scene(name), reference_settings(name)), read_reference(reference_file(name)))) << name;
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

// The test is sensitive in each scene: to light that is 3 % dimmer, and to surfaces that are 5 % less green.
TEST(References, SmallErrorsAreDetectedInEachScene) {
    for (const std::string& name : shipped_scene_names()) {
        const Scene scene = shipped_scene(name);
        const Reference reference = read_reference(reference_file(name));
        const RenderSettings settings = reference_settings(name);
        EXPECT_FALSE(looks_like(render(with_dimmer_light(scene, 0.97f), settings), reference)) << name << ": light";
        EXPECT_FALSE(looks_like(render(with_less_green(scene, 0.95f), settings), reference)) << name << ": colour";
    }
}

TEST(References, CutPathsAreDetected) {
    RenderSettings shorter = reference_settings("cornell");
    shorter.max_bounces = 4;
    EXPECT_FALSE(looks_like(render(shipped_scene("cornell"), shorter), read_reference(reference_file("cornell"))));
}

} // namespace
} // namespace blush::test::TEST_FILE
