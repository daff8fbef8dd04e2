// Covariance of pixels by the sampler, without path reuse: between the pixels of a block.
#include "core/sampler.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test::TEST_FILE {
namespace {

constexpr int side = 64, block = 1 << block_bits;

struct BlockErrors {
    double told = 0;    // variance of the mean of a block, from the errors of its pixels as if independent
    double happens = 0; // its mean square
    double factor = 0;  // that the renderer measures
};
// Over many seeds, of an image whose pixels all have the mean `expected`.
BlockErrors block_errors(const Scene& scene, RenderSettings settings, double expected) {
    BlockErrors errors;
    Renderer renderer({.threads = 1, .planes = {}});
    for (settings.seed = 0; settings.seed < 64; ++settings.seed) {
        renderer.update(scene, settings);
        renderer.render(0, settings.spp);
        const Frame frame = renderer.resolve();
        double sums[side / block][side / block] = {};
        for (size_t i = 0; i < side * side; ++i) sums[i / side / block][i % side / block] += double(frame.rgba[4 * i + 1]) - expected;
        for (const auto& row : sums)
            for (const double sum : row) errors.happens += sum * sum;
        for (const Vec3& e : renderer.resolve_error()) errors.told += double(e.y) * double(e.y);
        errors.factor += renderer.reuse_covariance().means / 64;
    }
    return errors;
}

// A closed room in which only chains of events matter: light that survives Russian roulette several times.
TEST(SamplerCovariance, IsMeasuredWhereErrorsAddUp) {
    Scene scene;
    place(scene, cube(true), emitter(2, 0.8f));
    scene.view = looking({0, 0, 0}, {0, 0, -1}, 1);
    RenderSettings settings = settings_for(side, side, 8);
    settings.strategy = Strategy::bsdf;
    settings.roulette = {.rule = Roulette::Rule::constant, .start = 1, .probability = 0.5f};
    const BlockErrors errors = block_errors(scene, settings, 10);
    EXPECT_GT(errors.factor, 1.05) << "the test needs correlated errors";
    // 4096 blocks.
    EXPECT_NEAR(errors.happens / errors.told / errors.factor, 1, 0.1);
}

// Errors by a single decision cancel, and count as independent.
TEST(SamplerCovariance, IsNoneWhereErrorsCancel) {
    Scene scene;
    place(scene, cube(true), emitter(2, 0.8f));
    scene.view = looking({0, 0, 0}, {0, 0, -1}, 1);
    RenderSettings settings = settings_for(side, side, 8);
    settings.strategy = Strategy::bsdf;
    settings.max_bounces = 1;
    settings.roulette = {.rule = Roulette::Rule::constant, .start = 1, .probability = 0.45f};
    const BlockErrors errors = block_errors(scene, settings, 3.6);
    EXPECT_LT(errors.happens / errors.told, 0.1);
    EXPECT_EQ(errors.factor, 1);
}

} // namespace
} // namespace blush::test::TEST_FILE
