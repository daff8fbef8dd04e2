// Rounds of a plan that is to reach an error.
#include "app/commands/plan/resume.h"
#include "tests/app/commands/plan/plan_support.h"

namespace blush::TEST_FILE {
namespace {

using test::expect_done;
using test::SmallPlan;
using test::TemporaryFolder;

TEST(PlanRounds, ErrorFallsWithTheNumberOfSamples) {
    EXPECT_EQ(samples_to_reach(0.01, 0.02, 64, 32, 1 << 20), 128);
    EXPECT_EQ(samples_to_reach(0.01, 0.011, 64, 32, 1 << 20), 96) << "whole chunks";
    EXPECT_EQ(samples_to_reach(0.01, 0.9, 64, 32, 1 << 20), 256) << "at most four times as many";
    EXPECT_EQ(samples_to_reach(0.01, 0, 64, 32, 1 << 20), 128) << "not known: twice as many";
    EXPECT_EQ(samples_to_reach(0.01, 0.9, 64, 32, 100), 100) << "the limit";
    EXPECT_EQ(samples_to_reach(0.01, 0.01, 64, 64, 1 << 20), 128) << "always some more";
}

TEST(PlanRounds, UpperEndIsThatOfTheText) {
    EXPECT_EQ(upper_end("0.0012 (0.001 to 0.0014)"), 0.0014);
    EXPECT_EQ(upper_end("1e-05 (9e-06 to 1.1e-05)"), 1.1e-05);
    for (const char* unknown : {"", "0.1", "0.1 (0.05 to", "(a to b)", ") to 1", "1 (0 to inf)"})
        EXPECT_EQ(upper_end(unknown), 0) << unknown;
}

void run_missing(const SmallPlan& plan) {
    for (const std::string& command : test::lines_of(plan.folder + "/missing.txt")) {
        const test::Finished finished = test::shell(command + " --quiet");
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
    }
}

TEST(PlanRounds, GoOnUntilTheIntervalSaysSo) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = test::scene_file("cornell"), .folder = folder / "plan"};
    const double wanted = 0.02;
    expect_done({"plan", plan.scene, "-o", plan.folder, "--quiet", "--size", "40x24", "--error", "0.02", "--chunk", "16"});
    EXPECT_EQ(plan.tasks(), 1) << "the first round is one chunk";
    int rounds = 0;
    for (; rounds < 20; ++rounds) {
        run_missing(plan);
        const nlohmann::json resumed = test::blush_json({"plan", "resume", plan.folder});
        ASSERT_TRUE(resumed.contains("added"));
        if (resumed["added"] == 0) break;
    }
    EXPECT_GE(rounds, 1);
    EXPECT_LT(rounds, 20);
    const nlohmann::json look = plan.status()["looks"][0];
    EXPECT_LE(upper_end(look["error"].get<std::string>()), wanted);
    EXPECT_EQ(look["samples"], look["merged"]);
    EXPECT_EQ(look["samples"].get<int64_t>() % 16, 0);
    EXPECT_TRUE(test::lines_of(plan.folder + "/missing.txt").empty());
    // The same bits as one process with so many samples.
    SmallPlan whole = plan;
    whole.spp = look["samples"];
    whole.render_whole(folder / "whole.exr");
    test::expect_same_pixels(plan.folder + "/merged/cornell.exr", folder / "whole.exr");
}

TEST(PlanRounds, EndAtTheLimit) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = test::scene_file("cornell"), .folder = folder / "plan"};
    expect_done({"plan", plan.scene, "-o", plan.folder, "--quiet", "--size", "40x24", "--error", "1e-9", "--spp", "40", "--chunk", "16"});
    for (int i = 0; i < 5; ++i) {
        run_missing(plan);
        expect_done({"plan", "resume", plan.folder, "--quiet"});
    }
    EXPECT_EQ(plan.status()["looks"][0]["merged"], 40);
    EXPECT_TRUE(test::lines_of(plan.folder + "/missing.txt").empty());
}

// Without an error to reach, resuming only lists what is missing.
TEST(PlanRounds, ListsWhatIsMissing) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = test::scene_file("cornell"), .folder = folder / "plan"};
    plan.make();
    EXPECT_EQ(test::lines_of(plan.folder + "/missing.txt"), test::lines_of(plan.folder + "/commands.txt"));
    expect_done(plan.task(3));
    expect_done({"plan", "resume", plan.folder, "--quiet"});
    std::vector<std::string> left = test::lines_of(plan.folder + "/commands.txt");
    left.erase(left.begin() + 2);
    EXPECT_EQ(test::lines_of(plan.folder + "/missing.txt"), left);
}

} // namespace
} // namespace blush::TEST_FILE
