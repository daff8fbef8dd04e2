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

// The test is sensitive: light cut after four bounces, walls 5 % less green.
TEST(References, SmallErrorsAreDetected) {
    const Scene cornell = shipped_scene("cornell");
    const Reference reference = read_reference(reference_file("cornell"));
    const RenderSettings settings = reference_settings("cornell");
    RenderSettings shorter = settings;
    shorter.max_bounces = 4;
    EXPECT_FALSE(looks_like(render(cornell, shorter), reference)) << "bounces";
    Scene changed = cornell;
    for (const auto& [id, material] : Table<Material>(cornell.materials)) {
        Material m = material;
        m.base_color.y *= 0.95f;
        changed.materials.set(id, m);
    }
    EXPECT_FALSE(looks_like(render(changed, settings), reference)) << "colour";
}

} // namespace
} // namespace blush::test::TEST_FILE
