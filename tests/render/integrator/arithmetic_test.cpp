// The estimator's arithmetic with exactly known values: light of 12, reflected by surfaces of 0.9 and 0.7, is 7.56.
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/integrator/estimator.h"
#include "render/integrator/kernel_settings.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test::TEST_FILE {
namespace {

constexpr float expected = 0.7f * 0.9f * 12.f;

TEST(Arithmetic, TwoGelsBeforeALight) {
    Scene scene;
    place(scene, floor_quad(2, 2), gel({0.7f, 0.7f, 0.7f}));
    place(scene, floor_quad(2, 1), gel({0.9f, 0.9f, 0.9f}));
    place(scene, floor_quad(2, 0), emitter(12));
    scene.view = looking_down(1, 3);
    for (const Strategy strategy : {Strategy::mis, Strategy::light, Strategy::bsdf}) {
        RenderSettings settings = settings_for(8, 8, 4);
        settings.strategy = strategy;
        for (const Vec3d& pixel : render(scene, settings).pixels) EXPECT_FLOAT_EQ(float(pixel.x), expected);
    }
}

// The same path vertex by vertex: the throughput after each scattering event, and the emission at its end.
TEST(Arithmetic, APathOverTwoDiffuseSurfaces) {
    constexpr Features s = all_features;
    Scene scene;
    place(scene, floor_quad(1, 0), lambert(0.7f));
    place(scene, floor_quad(1, 0), lambert(0.9f));
    place(scene, floor_quad(1, 0), emitter(12));
    RenderSettings settings;
    settings.strategy = Strategy::bsdf;
    settings.roulette.rule = Roulette::Rule::off;
    const Workers workers(1);
    RenderScene compiled;
    compiled.update(expand_area_lights(scene), settings, full_plan(), workers);
    const EstimatorSettings estimator = kernel_settings(settings, 1, 1);

    // Every vertex is hit from above, in the middle of the first triangle of one of the three.
    const auto from_above = [](Path<float> path) {
        path.ray = {{0, 1, 0}, {0, -1, 0}};
        return path;
    };
    const auto on = [](int32_t part) { return Hit<float>{1, 0.5f, 0.25f, part, -1, 0}; };
    Path<float> path = begin_path<s, float>(compiled.tables(), estimator, 0, 0, Sampler<float>{17u, 0u}, 0);
    Step<float> step = scatter<s, float>(compiled.tables(), estimator, from_above(path), on(0), 0, true);
    ASSERT_TRUE(step.continues);
    EXPECT_FALSE(step.emits);
    EXPECT_FLOAT_EQ(step.next.beta.x, 0.7f);
    EXPECT_FLOAT_EQ(step.next.pdf, step.next.ray.direction.y * inv_pi);
    step = scatter<s, float>(compiled.tables(), estimator, from_above(step.next), on(1), 1, true);
    ASSERT_TRUE(step.continues);
    EXPECT_FLOAT_EQ(step.next.beta.x, 0.7f * 0.9f);
    step = scatter<s, float>(compiled.tables(), estimator, from_above(step.next), on(2), 2, true);
    EXPECT_TRUE(step.emits);
    EXPECT_FALSE(step.continues);
    EXPECT_FLOAT_EQ(step.emitted.x, expected);
}

} // namespace
} // namespace blush::test::TEST_FILE
