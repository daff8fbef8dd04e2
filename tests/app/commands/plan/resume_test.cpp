// Rounds of a plan that is to reach an error, or with adaptive sampling.
#include "app/commands/plan/resume.h"
#include "tests/app/commands/plan/plan_support.h"

namespace blush::TEST_FILE {
namespace {

using test::blush;
using test::expect_done;
using test::SmallPlan;
using test::Started;
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
    const double wanted = 0.002;
    expect_done({"plan", plan.scene, "-o", plan.folder, "--quiet", "--size", "40x24", "--error", "0.002", "--chunk", "16"});
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

// Of adaptive plans: tasks are the pilot, then all samples behind it by the allocation that its merge decided.
class AdaptivePlan : public testing::Test {
protected:
    TemporaryFolder folder;
    SmallPlan plan{.scene = test::scene_file("veach-mis"), .folder = folder / "plan", .spp = 40};

    std::string allocation() const { return plan.folder + "/allocations/veach-mis.json"; }
    nlohmann::json file() const { return test::json_of(plan.folder + "/plan.json"); }
    void render_pilot() {
        plan.make({"--adaptive", "on", "--layers", "samples"});
        run_missing(plan);
        expect_done({"plan", "resume", plan.folder, "--quiet"});
    }
};

TEST_F(AdaptivePlan, RendersTheAdaptiveImageInEveryBit) {
    plan.make({"--adaptive", "on", "--layers", "samples"});
    EXPECT_EQ(plan.tasks(), 2) << "the halves of the pilot";
    EXPECT_EQ(file()["tasks"][1]["samples"], nlohmann::json({8, 16}));
    run_missing(plan);
    const nlohmann::json pilot = plan.status();
    EXPECT_EQ(pilot["unfinished"], 1);
    EXPECT_EQ(pilot["planned"], 40) << "the samples behind the pilot are known";
    EXPECT_NE(expect_done({"plan", "status", plan.folder}).out.find("`blush plan resume` begins the next round"), std::string::npos);
    expect_done({"plan", "resume", plan.folder, "--quiet"});
    EXPECT_EQ(file()["looks"][0]["allocation"], test::json_of(allocation())["hash"]);
    EXPECT_EQ(plan.tasks(), 4) << "16:32 and 32:40";
    // The last first, and one in two pieces.
    expect_done(plan.task(4));
    Started(plan.task(3)).end_after(std::chrono::milliseconds(150), SIGTERM);
    run_missing(plan);
    expect_done({"plan", "resume", plan.folder, "--quiet"});
    EXPECT_TRUE(test::lines_of(plan.folder + "/missing.txt").empty());
    EXPECT_EQ(plan.status()["unfinished"], 0);
    expect_done({"render", plan.scene, "-o", folder / "whole.exr", "--quiet", "--size", "40x24", "--spp", "40", "--layers", "samples,film",
                 "--adaptive", "on"});
    test::expect_same_pixels(plan.folder + "/merged/veach-mis.exr", folder / "whole.exr");
    const std::vector<float> samples = read_layers(plan.folder + "/merged/veach-mis.exr")->find("samples.Y")->values;
    EXPECT_EQ(samples, read_layers(folder / "whole.exr")->find("samples.Y")->values);
    EXPECT_LT(*std::ranges::min_element(samples), *std::ranges::max_element(samples)) << "not uniform: else this would prove nothing";
}

TEST_F(AdaptivePlan, TasksRefuseAnotherAllocation) {
    render_pilot();
    std::string text = test::text_of(allocation());
    // A valid file of another pilot.
    const SmallPlan other{.scene = plan.scene, .folder = folder / "other", .spp = 40};
    other.make({"--adaptive", "on", "--seed", "7"});
    run_missing(other);
    expect_done({"plan", "resume", other.folder, "--quiet"});
    std::filesystem::copy_file(other.folder + "/allocations/veach-mis.json", allocation(),
                               std::filesystem::copy_options::overwrite_existing);
    const test::Finished foreign = plan.run(3);
    EXPECT_EQ(foreign.exit_code, 1);
    EXPECT_NE(foreign.err.find("is not the allocation of the plan for the look veach-mis"), std::string::npos) << foreign.err;
    text[text.size() / 2] ^= 1;
    test::write_text(allocation(), text);
    EXPECT_EQ(plan.run(3).exit_code, 1);
    std::filesystem::remove(allocation());
    EXPECT_EQ(plan.run(3).exit_code, 1);
    EXPECT_FALSE(std::filesystem::exists(plan.part("veach-mis", "0000000016-0000000032")));
}

// Killed between the merge of the pilot and the new plan.
TEST_F(AdaptivePlan, PilotIsMergedAgainIfItsAllocationIsLost) {
    plan.make({"--adaptive", "on"});
    run_missing(plan);
    expect_done({"plan", "merge", plan.folder, "--quiet"});
    const std::string decided = test::text_of(allocation());
    for (const bool damaged : {true, false}) {
        std::filesystem::remove(allocation());
        if (damaged) test::write_text(allocation(), "{}");
        EXPECT_EQ(blush({"plan", "resume", plan.folder, "--quiet"}).exit_code, damaged ? 1 : 0);
    }
    EXPECT_EQ(test::text_of(allocation()), decided);
    EXPECT_EQ(plan.tasks(), 4);
}

TEST_F(AdaptivePlan, ReachesAnError) {
    plan.scene = test::scene_file("cornell");
    expect_done(
        {"plan", plan.scene, "-o", plan.folder, "--quiet", "--size", "40x24", "--adaptive", "on", "--error", "0.05", "--chunk", "16"});
    for (int round = 0; round < 20 && !test::lines_of(plan.folder + "/missing.txt").empty(); ++round) {
        run_missing(plan);
        expect_done({"plan", "resume", plan.folder, "--quiet"});
    }
    const nlohmann::json look = plan.status()["looks"][0];
    EXPECT_LE(upper_end(look["error"].get<std::string>()), 0.05);
    EXPECT_GT(look["merged"], 16);
    plan.spp = look["merged"];
    expect_done({"render", plan.scene, "-o", folder / "whole.exr", "--quiet", "--size", "40x24", "--spp", std::to_string(plan.spp),
                 "--layers", "film", "--adaptive", "on"});
    test::expect_same_pixels(plan.folder + "/merged/cornell.exr", folder / "whole.exr");
}

TEST_F(AdaptivePlan, OfFewSamplesIsItsPilot) {
    plan.spp = 12;
    render_pilot();
    EXPECT_TRUE(test::lines_of(plan.folder + "/missing.txt").empty());
    EXPECT_EQ(plan.status()["looks"][0]["merged"], 12);
    EXPECT_FALSE(std::filesystem::exists(allocation()));
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
