// Statistics of Russian roulette, and the lab that evaluates it: unbiased rules pass, the two that darken the image do not.
#include "measure/lab/roulette_comparison.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test::TEST_FILE {
namespace {

using statistics::Moments;
using statistics::z_test;

Roulette constant(float p) {
    Roulette r;
    r.rule = Roulette::Rule::constant;
    r.probability = p;
    r.start = 1;
    return r;
}

// A closed room where paths end only by roulette.
Scene closed_room() {
    Scene scene;
    place(scene, cube(true), emitter(1, 0.5f));
    scene.view = looking({0, 0, 0}, {0, 0, -1}, 1);
    return scene;
}

TEST(RouletteColumns, PathsInAClosedRoomAreGeometric) {
    constexpr double q = 0.7;
    RenderSettings settings = settings_for(32, 32, 16);
    settings.roulette = constant(float(q));
    Renderer renderer({.threads = 2, .planes = {.roulette = true}});
    renderer.update(closed_room(), settings);
    renderer.render(0, settings.spp);
    const Frame frame = renderer.resolve();
    Moments lengths;
    for (const float length : frame.path_length) lengths.add(double(length));
    EXPECT_TRUE(z_test(lengths, 1 / (1 - q)));
    for (const float survival : frame.survival) EXPECT_NEAR(survival, q, 1e-6);
    ASSERT_EQ(int(frame.path_counts.size()), max_counted_bounces);
    EXPECT_EQ(frame.path_counts[0].alive, 32 * 32 * 16);
    int64_t rays = 0;
    for (const PathCounts& c : frame.path_counts) rays += c.alive;
    EXPECT_EQ(rays, frame.rays.camera + frame.rays.bounce);
    for (int k = 0; k < 8; ++k) {
        const PathCounts& c = frame.path_counts[size_t(k)];
        EXPECT_EQ(c.rr_applied, c.alive) << k;
        EXPECT_EQ(c.survived, frame.path_counts[size_t(k) + 1].alive) << k;
        const double error = std::sqrt(q * (1 - q) / double(c.rr_applied));
        EXPECT_LT(std::abs(double(c.survived) / double(c.rr_applied) - q), 5 * error) << k;
    }
}

TEST(RouletteColumns, DoNotChangeTheImageAndAreDeterministic) {
    const Scene scene = shipped_scene("cornell");
    const auto frame = [&](bool roulette, unsigned threads) {
        Renderer renderer({.threads = threads, .planes = {.roulette = roulette}});
        renderer.update(scene, settings_for(40, 24, 4));
        renderer.render(0, 4);
        return renderer.resolve();
    };
    const Frame without = frame(false, 1), one = frame(true, 1), three = frame(true, 3);
    EXPECT_TRUE(without.path_length.empty() && without.survival.empty() && without.path_counts.empty());
    EXPECT_EQ(without.rgba, one.rgba);
    EXPECT_EQ(one.path_length, three.path_length);
    EXPECT_EQ(one.survival, three.survival);
    EXPECT_EQ(one.path_counts, three.path_counts);
}

RouletteReport report_of(const Roulette& roulette, int max_bounces, int rounds) {
    RenderSettings settings = settings_for(320, 200, 1);
    settings.roulette = roulette;
    settings.max_bounces = max_bounces;
    RouletteComparison lab({.threads = 1, .planes = {}});
    lab.begin(shipped_scene("cornell"), settings, 24, 4);
    for (int i = 0; i < rounds; ++i) lab.round();
    return lab.report();
}

TEST(RouletteComparison, UnbiasedRulesPass) {
    for (const char* text : {"max,start=3", "luminance,start=1", "sqrt,start=2", "constant=0.6,start=1", "max,start=1,cap=0.5",
                             "adjoint,start=1", "efficiency,start=2"}) {
        const RouletteReport report = report_of(*parse_roulette(text), unlimited_bounces, 24);
        EXPECT_FALSE(report.biased()) << text;
        EXPECT_LT(report.rule.path_length, report.none.path_length) << text;
        EXPECT_GT(report.bias[0].error, 0) << text;
    }
}

TEST(RouletteComparison, DetectsTheBiasedCutAndItsBounces) {
    const RouletteReport report = report_of(*parse_roulette("biased-cut=0.3,start=1"), unlimited_bounces, 24);
    EXPECT_TRUE(report.biased());
    EXPECT_TRUE(report.bias[0].significant);
    EXPECT_LT(report.bias[0].difference, 0);
    EXPECT_EQ(report.bias[1].difference, 0) << "directly visible emission is unaffected";
    int darkened = 0;
    double by_bounce = 0;
    for (size_t i = 1; i < report.bias.size(); ++i) {
        darkened += report.bias[i].significant;
        by_bounce += report.bias[i].difference;
    }
    EXPECT_GT(darkened, 2);
    EXPECT_NEAR(by_bounce, report.bias[0].difference, 1e-9);
}

TEST(RouletteComparison, DetectsABareBounceCap) {
    const RouletteReport report = report_of(*parse_roulette("off"), 3, 24);
    EXPECT_TRUE(report.bias[0].significant);
    EXPECT_LT(report.bias[0].difference, 0);
    for (size_t i = 1; i < report.bias.size(); ++i) {
        const bool beyond = i - 1 > 3;
        EXPECT_EQ(report.bias[i].significant, beyond) << report.bias[i].name;
        EXPECT_NEAR(report.bias[i].difference, beyond ? -report.bias[i].share : 0, 1e-12) << report.bias[i].name;
    }
}

TEST(RouletteComparison, NothingDiffersFromItself) {
    const RouletteReport report = report_of(*parse_roulette("off"), unlimited_bounces, 16);
    for (const RouletteBias& bias : report.bias) EXPECT_EQ(bias.difference, 0);
    EXPECT_FALSE(report.biased());
    EXPECT_EQ(report.rule.variance, report.none.variance);
    EXPECT_EQ(report.rule.alive, report.none.alive);
    EXPECT_GT(report.gain_error, 0) << "the measured time differs, so the gain has an error";
}

TEST(Trials, HaveMeanAndStandardError) {
    Trials t;
    for (const double x : {1.0, 2.0, 4.0, 5.0}) t.add(x);
    EXPECT_EQ(t.mean(), 3);
    EXPECT_NEAR(t.variance(), 10.0 / 3, 1e-12);
    EXPECT_NEAR(t.error(), std::sqrt(10.0 / 12), 1e-12);
}

} // namespace
} // namespace blush::test::TEST_FILE
