#include "scene/render_settings.h"

#include <gtest/gtest.h>

#include <random>

namespace blush::TEST_FILE {
namespace {

TEST(SameImage, OnlyStopRulesMayDiffer) {
    const RenderSettings a;
    RenderSettings b = a;
    b.spp = 1000;
    b.seconds = 3;
    b.error = 0.01;
    EXPECT_TRUE(same_image(a, b));
    b.seed = 1;
    EXPECT_FALSE(same_image(a, b));
    b = a;
    b.width = 640;
    EXPECT_FALSE(same_image(a, b));
    b = a;
    b.first_sample = 3;
    EXPECT_FALSE(same_image(a, b));
}

TEST(Roulette, ReadsWhatTheManualShows) {
    EXPECT_EQ(*parse_roulette("sqrt,start=3"), Roulette{});
    EXPECT_EQ(parse_roulette("off")->rule, Roulette::Rule::off);
    EXPECT_EQ(parse_roulette("luminance")->rule, Roulette::Rule::luminance);
    EXPECT_EQ(parse_roulette("splitting")->rule, Roulette::Rule::splitting);
    EXPECT_EQ(parse_roulette("sqrt,start=0")->start, 0);
    const Roulette constant = *parse_roulette("constant=0.7,start=1,floor=0.05,cap=0.95");
    EXPECT_EQ(constant, (Roulette{Roulette::Rule::constant, 1, 0.05f, 0.95f, 0.7f, 0.1f}));
    const Roulette cut = *parse_roulette("biased-cut=0.05");
    EXPECT_EQ(cut.rule, Roulette::Rule::biased_cut);
    EXPECT_EQ(cut.threshold, 0.05f);
}

TEST(Roulette, TextRoundTrips) {
    EXPECT_EQ(to_string(Roulette{}), "sqrt,start=3");
    std::mt19937 rng(5);
    std::uniform_real_distribution<float> u(0.001f, 1);
    for (int i = 0; i < 1000; ++i) {
        Roulette r;
        r.rule = Roulette::Rule(rng() % 10);
        r.start = int(rng() % 10);
        if (rng() % 2) r.cap = u(rng);
        if (rng() % 2) r.floor = r.cap * u(rng);
        if (r.rule == Roulette::Rule::constant) r.probability = u(rng);
        if (r.rule == Roulette::Rule::biased_cut) r.threshold = u(rng);
        const Result<Roulette> back = parse_roulette(to_string(r));
        ASSERT_TRUE(back) << to_string(r) << ": " << back.error().text();
        EXPECT_EQ(*back, r) << to_string(r);
    }
}

TEST(Roulette, BadTextIsRefusedWithTheReason) {
    const auto error = [](std::string_view text) {
        const Result<Roulette> r = parse_roulette(text);
        return r ? "accepted" : r.error().text();
    };
    EXPECT_EQ(
        error("often"),
        "unknown roulette rule \"often\" (known: auto, off, max, luminance, sqrt, constant, adjoint, efficiency, splitting, biased-cut)");
    EXPECT_EQ(error(""),
              "unknown roulette rule \"\" (known: auto, off, max, luminance, sqrt, constant, adjoint, efficiency, splitting, biased-cut)");
    EXPECT_EQ(error("constant"), "roulette rule constant needs a number, as in constant=0.5");
    EXPECT_EQ(error("max=1"), "roulette rule max takes no number");
    EXPECT_EQ(error("constant=0"), "roulette's constant must be a number above 0 and at most 1, not \"0\"");
    EXPECT_EQ(error("constant=nan"), "roulette's constant must be a number above 0 and at most 1, not \"nan\"");
    EXPECT_EQ(error("max,start=-1"), "roulette's start must be a whole number from 0, not \"-1\"");
    EXPECT_EQ(error("max,start=1.5"), "roulette's start must be a whole number from 0, not \"1.5\"");
    EXPECT_EQ(error("max,floor=2"), "roulette's floor must be a number from 0 to 1, not \"2\"");
    EXPECT_EQ(error("max,end=4"), "unknown roulette parameter \"end\" (known: start, floor, cap)");
    EXPECT_EQ(error("max,"), "unknown roulette parameter \"\" (known: start, floor, cap)");
    EXPECT_EQ(error("max,floor=0.9,cap=0.5"), "roulette's floor is above its cap");
    EXPECT_EQ(error("max,start=99999999999"), "roulette's start must be a whole number from 0, not \"99999999999\"");
}

TEST(Reuse, TextRoundTrips) {
    for (const int n : {1, 4, 8, 16}) EXPECT_EQ(*parse_reuse(reuse_text(n)), n);
    for (const char* bad : {"", "1", "on", "5", "16x"}) EXPECT_FALSE(parse_reuse(bad)) << bad;
    EXPECT_TRUE(reuse_text(3).empty());
}

TEST(MaxBounces, TextRoundTrips) {
    for (const int n : {0, 1, 17, unlimited_bounces}) EXPECT_EQ(*parse_max_bounces(max_bounces_text(n)), n);
    for (const char* bad : {"", "-1", "many", "3x", "1.5", "99999999999"}) EXPECT_FALSE(parse_max_bounces(bad)) << bad;
}

TEST(MisHeuristic, TextRoundTrips) {
    for (const char* text : {"balance", "power=2", "power=8", "cutoff=0.25", "cutoff=0", "maximum"})
        EXPECT_EQ(to_string(*parse_heuristic(text)), text);
    EXPECT_EQ(*parse_heuristic("power"), MisHeuristic{});
    EXPECT_EQ(*parse_heuristic("power=1"), *parse_heuristic("balance"));
    for (const char* bad :
         {"", "power=0", "power=9", "power=1.5", "cutoff=-1", "cutoff=2", "cutoff=nan", "maximum=1", "balance=1", "Power"})
        EXPECT_FALSE(parse_heuristic(bad)) << bad;
}

TEST(EnumNames, RoundTrip) {
    for (const Strategy s : {Strategy::mis, Strategy::light, Strategy::bsdf}) EXPECT_EQ(*parse_strategy(to_string(s)), s);
    for (const CausticStrategy c : {CausticStrategy::automatic, CausticStrategy::off, CausticStrategy::guiding,
                                    CausticStrategy::light_paths, CausticStrategy::manifold})
        EXPECT_EQ(*parse_caustics(to_string(c)), c);
    for (const PixelFilter f : {PixelFilter::blackman_harris, PixelFilter::box}) EXPECT_EQ(*parse_filter(to_string(f)), f);
    for (const SamplerType n : {SamplerType::sobol, SamplerType::random}) EXPECT_EQ(*parse_sampler(to_string(n)), n);
    EXPECT_EQ(parse_sampler("halton").error().text(), "unknown sampler \"halton\" (known: sobol, random)");
    EXPECT_EQ(parse_strategy("MIS").error().text(), "unknown strategy \"MIS\" (known: mis, light, bsdf)");
    EXPECT_EQ(parse_caustics("on").error().text(),
              "unknown strategy for caustics \"on\" (known: auto, off, guiding, light-paths, manifold)");
    EXPECT_EQ(parse_filter("gauss").error().text(), "unknown filter \"gauss\" (known: blackman-harris, box)");
}

TEST(Clamp, IsParsedAndPrinted) {
    EXPECT_EQ(*parse_clamp("off"), Clamp{});
    EXPECT_EQ(*parse_clamp("10"), (Clamp{10, false}));
    EXPECT_EQ(*parse_clamp("0.5,all"), (Clamp{0.5f, true}));
    for (const char* text : {"off", "10", "0.5,all"}) EXPECT_EQ(to_string(*parse_clamp(text)), text);
    for (const char* bad : {"", "0", "-1", "nan", "inf", "10,some", "10,all,all", "all", "off,all"}) EXPECT_FALSE(parse_clamp(bad)) << bad;
}

} // namespace
} // namespace blush::TEST_FILE
