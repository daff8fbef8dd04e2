// Survivors of Russian roulette: fates and weights of paths, and that roulette leaves the mean unchanged.
#include "core/math.h"
#include "tests/support/sample_project.h"
#include "ui/views/lab/survivors_view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace blush::TEST_FILE {
namespace {

using Fate = Survivor::Fate;

std::shared_ptr<const RecordedPath> path(std::vector<PathVertex> vertices, float radiance = 0) {
    auto p = std::make_shared<RecordedPath>();
    p->vertices = std::move(vertices);
    p->radiance = {radiance, radiance, radiance};
    return p;
}
PathVertex survives(float q) { return {.roulette = true, .survival = q}; }
PathVertex killed(float q) { return {.roulette = true, .survival = q, .end = PathEnd::roulette}; }
PathVertex escapes() { return {.end = PathEnd::escaped}; }

TEST(Survivors, HaveTheWeightOfTheirDecisions) {
    PathSet set;
    set.paths = {path({survives(0.5f), survives(0.25f), escapes()}), path({survives(0.5f), killed(0.25f)}), path({escapes()})};
    EXPECT_EQ(most_bounces(set), 3);
    using List = std::vector<Survivor>;
    const Survivors before = survivors_behind(set, 0), first = survivors_behind(set, 1), second = survivors_behind(set, 2),
                    all = survivors_behind(set, 9);
    EXPECT_EQ(before.paths, (List{{Fate::lives, 1}, {Fate::lives, 1}, {Fate::lives, 1}}));
    EXPECT_EQ(before.weight, 3);
    EXPECT_EQ(first.paths, (List{{Fate::lives, 2}, {Fate::lives, 2}, {Fate::ended, 1}}));
    EXPECT_EQ(first.living_weight, 2);
    EXPECT_EQ(first.weight, 5);
    EXPECT_EQ(second.paths, (List{{Fate::lives, 8}, {Fate::killed, 0}, {Fate::ended, 1}}));
    EXPECT_EQ(second.counts, (std::array<int64_t, 3>{1, 1, 1}));
    EXPECT_EQ(second.living_weight, 8);
    EXPECT_EQ(all.paths, (List{{Fate::ended, 8}, {Fate::killed, 0}, {Fate::ended, 1}}));
    EXPECT_EQ(all.living_weight, 0) << "none lives";
}

TEST(Survivors, CostsAreThoseOfTheSamples) {
    PathSet set;
    EXPECT_FALSE(cost_of(set));
    set.paths = {path({escapes()}, 1), path({survives(0.5f), escapes()}, 3), path({escapes()}, std::nanf(""))};
    set.means = running_means(std::vector<double>{1, 3});
    const std::optional<PathCost> cost = cost_of(set);
    ASSERT_TRUE(cost);
    EXPECT_NEAR(cost->mean, 2, 1e-6);
    EXPECT_NEAR(cost->variance, 2, 1e-6);
    EXPECT_NEAR(cost->vertices, 4 / 3., 1e-12) << "invalid samples cost as much";
}

// The paths that the lab traces, without its thread.
std::shared_ptr<const PathSet> traced(const Roulette& roulette) {
    PathWork::Input input;
    input.scene = test::sample_project().project.scene;
    input.settings = {.width = 32, .height = 24, .roulette = roulette};
    input.pixels = {{16, 12}};
    input.samples = SurvivorsView::most_paths;
    PathWork work;
    work.begin(input);
    do EXPECT_TRUE(work.round([] { return true; }));
    while (!PathWork::is_good(work.output()));
    return work.output();
}

// Both means over the paths of a pixel: of the weights, which is 1 in expectation, and of the light. Sobol points are stratified, so
// that the variance of independent samples is an upper bound.
TEST(Survivors, RouletteLeavesTheMeansUnchanged) {
    const auto with = traced({.rule = Roulette::Rule::constant, .start = 1, .probability = 0.6f}),
               without = traced({.rule = Roulette::Rule::off});
    constexpr double z = 4; // two-sided 6e-5
    for (const int64_t bounce : {int64_t(1), int64_t(2), most_bounces(*with)}) {
        const Survivors s = survivors_behind(*with, bounce);
        const double n = double(s.paths.size()), mean = s.weight / n;
        double squares = 0;
        for (const Survivor& path : s.paths) squares += (path.weight - mean) * (path.weight - mean);
        EXPECT_GT(s.counts[size_t(Fate::killed)], 0);
        EXPECT_NEAR(mean, 1, z * std::sqrt(squares / (n - 1) / n)) << "bounce " << bounce;
    }
    const std::optional<PathCost> cost = cost_of(*with), none = cost_of(*without);
    ASSERT_TRUE(cost && none);
    const double n = double(with->paths.size());
    EXPECT_GT(none->mean, 0);
    EXPECT_NEAR(cost->mean, none->mean, z * std::sqrt((cost->variance + none->variance) / n));
    EXPECT_LT(cost->vertices, none->vertices);
}

TEST(Survivors, PlaybackBeginsAgainAtTheEnd) {
    SurvivorsView view;
    view.step_due = 10;
    EXPECT_EQ(play(view, 2, 9), 1);
    EXPECT_EQ(view.bounce, 0) << "not due";
    for (const int64_t expected : {1, 2, 0}) {
        play(view, 2, view.step_due);
        EXPECT_EQ(view.bounce, expected);
    }
}

} // namespace
} // namespace blush::TEST_FILE
