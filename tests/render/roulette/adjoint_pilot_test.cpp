// Russian roulette by the learned adjoint: where it is used, that it adds no bias, and that it does not depend on how the image is
// rendered.
#include "render/roulette/adjoint_pilot.h"

#include "render/diagnostics/path_recorder.h"
#include "tests/render/pilots/pilot_checks.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

#include <cmath>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using Rule = Roulette::Rule;
constexpr const char* feature = "learned roulette";

RenderSettings settings_of(Rule rule, int width = 64, int height = 36, int64_t spp = 8) {
    RenderSettings settings = settings_for(width, height, spp);
    settings.roulette.rule = rule;
    return settings;
}

// Emits and reflects the same everywhere.
Scene closed_room(float albedo) {
    Scene scene;
    place(scene, cube(true), emitter(1, albedo));
    scene.view = looking({0, 0, 0}, {0, 0, -1}, 1);
    return scene;
}

AdjointPilot learned(const Scene& scene, const RenderSettings& settings) {
    return learned_by_every_kernel(scene, settings,
                                   [](const KernelContext& context, auto&&... others) { return learn_adjoint(context, 1, others...); });
}

// A path of n bounces of albedo 1/2 finds the radiance 2 (1 - 2^-k) behind the vertex that k bounces follow: 2 - 2 / n on average.
TEST(AdjointPilot, LearnsTheRadianceOfAClosedRoom) {
    RenderSettings settings = settings_of(Rule::adjoint, 32, 32);
    settings.strategy = Strategy::bsdf;
    settings.roulette.start = 1000; // no noise of roulette: each path has the length that the pilot allows
    const AdjointPilot pilot = learned(closed_room(0.5f), settings);
    ASSERT_FALSE(pilot.field.empty());
    const AdjointTables tables = pilot.field.tables(32, 32);
    constexpr int n = 32;
    statistics::Moments values;
    for (float u = -0.9375f; u < 1; u += 0.125f)
        for (float v = -0.9375f; v < 1; v += 0.125f)
            for (const float side : {-1.f, 1.f}) {
                values.add(double(adjoint_value<float>(tables, {side, u, v}, {-side, 0, 0})));
                values.add(double(adjoint_value<float>(tables, {u, side, v}, {0, -side, 0})));
                values.add(double(adjoint_value<float>(tables, {u, v, side}, {0, 0, -side})));
            }
    EXPECT_TRUE(statistics::z_test(values, 2 - 2.0 / n));
    EXPECT_LT(values.error(), 0.002);
    EXPECT_NEAR(pixel_importance<float>(tables, 7.f, 9.f), 0.5f, 1e-4f);
    EXPECT_NEAR(pilot.field.relative_variance(), 0, 1e-6);
}

TEST(AdjointPilot, IsUsedWhereItPays) {
    const FeatureUse use = decided_line(shipped_scene("corridor"), settings_of(Rule::automatic, 128, 72), feature);
    EXPECT_TRUE(use.used) << use.why;
    EXPECT_GT(use.bytes.value_or(0), 0);
    ASSERT_TRUE(use.pilot);
    EXPECT_LT(use.pilot->cost(), 0.9);
    EXPECT_NE(use.why.find("of that of the square root"), std::string::npos) << use.why;
}

TEST(AdjointPilot, IsLeftOutWhereItDoesNotPay) {
    const FeatureUse short_paths = decided_line(shipped_scene("card-and-mug"), settings_of(Rule::automatic, 128, 72), feature);
    EXPECT_FALSE(short_paths.used);
    EXPECT_NE(short_paths.why.find("% of the rays at most"), std::string::npos) << short_paths.why;
    EXPECT_FALSE(decided_line(shipped_scene("cornell"), settings_of(Rule::automatic, 128, 72), feature).used);
    const FeatureUse other = decided_line(shipped_scene("corridor"), settings_of(Rule::sqrt), feature);
    EXPECT_FALSE(other.used);
    EXPECT_EQ(other.why, "the rule of Russian roulette reads the throughput alone");
    Scene dark;
    place(dark, cube(true), lambert(0.8f));
    dark.view = looking({0, 0, 0}, {0, 0, -1}, 1);
    EXPECT_FALSE(decided_line(dark, settings_of(Rule::adjoint), feature).used);
}

// A pilot would be too short to judge caustics.
TEST(AdjointPilot, StartsRouletteLaterWhereManifoldsAreSampled) {
    const FeatureUse pool = decided_line(shipped_scene("pool"), settings_of(Rule::automatic), feature);
    EXPECT_TRUE(pool.used);
    EXPECT_NE(pool.why.find("no path ends before bounce 6"), std::string::npos) << pool.why;
    PathRecorder recorder;
    recorder.update(shipped_scene("pool"), settings_of(Rule::automatic));
    ASSERT_TRUE(recorder.decide());
    int applied = 0;
    for (int y = 0; y < 36; y += 4)
        for (int x = 0; x < 64; x += 4)
            for (const PathVertex& v : recorder.record(x, y, 1).vertices) {
                EXPECT_FALSE(v.roulette && v.bounce < 5);
                applied += v.roulette;
            }
    EXPECT_GT(applied, 0);
}

// Without a pilot that pays, automatic is sqrt to the bit.
TEST(AdjointPilot, CostsNothingWhereItIsLeftOut) {
    const Scene scene = shipped_scene("card-and-mug");
    EXPECT_TRUE(same_pixels(rendered_in_parts(scene, settings_of(Rule::automatic), {{0, 8}}),
                            rendered_in_parts(scene, settings_of(Rule::sqrt), {{0, 8}})));
}

TEST(AdjointPilot, ReducesTheVariance) {
    const auto variance = [&](Rule rule) {
        std::vector<statistics::Moments> blocks;
        RenderSettings settings = settings_of(rule, 32, 18, 16);
        settings.roulette.start = 1;
        double sum = 0;
        for (settings.seed = 1; settings.seed <= 16; ++settings.seed) {
            const Frame frame = rendered_in_parts(shipped_scene("corridor"), settings, {{4, 16}});
            blocks.resize(size_t(frame.width * frame.height));
            for (size_t k = 0; k < blocks.size(); ++k) blocks[k].add(double(frame.rgba[4 * k + 1]));
        }
        for (const auto& block : blocks) sum += block.variance();
        return sum;
    };
    EXPECT_LT(variance(Rule::adjoint), 0.6 * variance(Rule::sqrt));
}

struct Unbiased : testing::TestWithParam<std::pair<const char*, Rule>> {};
TEST_P(Unbiased, AgreesWithoutRoulette) {
    const auto [name, rule] = GetParam();
    RenderSettings settings = settings_of(rule, 32, 18, 512);
    settings.roulette.start = 1;
    const auto with = render(shipped_scene(name), settings).blocks(8, 6);
    settings.roulette = {.rule = Rule::sqrt, .start = 8};
    settings.seed = 3;
    EXPECT_TRUE(same_means(with, render(shipped_scene(name), settings).blocks(8, 6)));
}
INSTANTIATE_TEST_SUITE_P(AdjointPilot, Unbiased,
                         testing::Values(std::pair{"corridor", Rule::adjoint}, std::pair{"corridor", Rule::efficiency},
                                         std::pair{"cornell", Rule::adjoint}, std::pair{"cornell", Rule::efficiency},
                                         std::pair{"veach-mis", Rule::efficiency}, std::pair{"prism", Rule::adjoint},
                                         std::pair{"corridor", Rule::splitting}, std::pair{"cornell", Rule::splitting},
                                         std::pair{"veach-mis", Rule::splitting}, std::pair{"prism", Rule::splitting}));

TEST(AdjointPilot, DecidesOverAllSamplesButTheFirstFour) {
    const Scene scene = shipped_scene("corridor");
    RenderSettings settings = settings_of(Rule::adjoint);
    const Frame whole = rendered_in_parts(scene, settings, {{0, 8}});
    EXPECT_TRUE(same_pixels(whole, rendered_in_parts(scene, settings, {{0, 1}, {1, 7}})));
    EXPECT_TRUE(same_pixels(whole, rendered_in_parts(scene, settings, {{0, 3}, {3, 2}, {5, 3}}, 1)));
    // The first four as with sqrt, and not the fifth.
    RenderSettings other = settings_of(Rule::sqrt);
    EXPECT_TRUE(same_pixels(rendered_in_parts(scene, settings, {{0, 4}}), rendered_in_parts(scene, other, {{0, 4}})));
    EXPECT_FALSE(same_pixels(rendered_in_parts(scene, settings, {{0, 5}}), rendered_in_parts(scene, other, {{0, 5}})));
    settings.adaptive = true;
    EXPECT_TRUE(same_pixels(rendered_in_parts(scene, settings, {{0, 1}, {0, 1}, {0, 22}}), rendered_in_parts(scene, settings, {{0, 24}})));
}

TEST(AdjointPilot, IsFollowedByTheLogOfAPath) {
    expect_log_follows_image(shipped_scene("corridor"), settings_of(Rule::efficiency, 80, 48, 8));
}

// Light by bounces stays that of shorter paths.
TEST(AdjointPilot, DoesNotDependOnTheLimitOfBounces) {
    RenderSettings settings = settings_of(Rule::adjoint, 32, 18);
    const Scene scene = shipped_scene("corridor");
    const AdjointField all = learned(scene, settings).field;
    settings.max_bounces = 4;
    EXPECT_EQ(learned(scene, settings).field, all);
}

} // namespace
} // namespace blush::test::TEST_FILE
