// run-local.sh of a plan: all rounds on this machine, stopped and begun again.
#include "tests/app/commands/plan/plan_support.h"
#include "tests/support/eventually.h"

namespace blush::test::TEST_FILE {
namespace {

class LocalScript : public testing::Test {
protected:
    TemporaryFolder folder;
    // A quote in the name: the script has to quote it.
    SmallPlan plan{.scene = scene_file("cornell"), .folder = folder / "it's a plan"};

    std::string script() const { return plan.folder + "/run-local.sh"; }
    std::string merged(const std::string& look) const { return plan.folder + "/merged/" + look + ".exr"; }
};

TEST_F(LocalScript, RendersAndMergesAll) {
    plan.make();
    const Finished finished = run({script(), "--jobs", "2"});
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    plan.render_whole(folder / "whole.exr");
    expect_same_pixels(merged("cornell"), folder / "whole.exr");
    EXPECT_TRUE(std::filesystem::exists(plan.folder + "/contact-sheet.png"));
    EXPECT_FALSE(std::filesystem::exists(plan.folder + "/local.pid"));
    EXPECT_EQ(run({script()}).exit_code, 0) << "nothing to do";
}

TEST_F(LocalScript, GoesThroughTheRoundsOfAdaptiveSampling) {
    plan.scene = scene_file("veach-mis");
    plan.make({"--adaptive", "on"});
    EXPECT_EQ(run({script()}).exit_code, 0);
    expect_done({"render", plan.scene, "-o", folder / "whole.exr", "--quiet", "--size", "40x24", "--spp", "64", "--layers", "film",
                 "--adaptive", "on"});
    expect_same_pixels(merged("veach-mis"), folder / "whole.exr");
}

TEST_F(LocalScript, MergesWhileItRendersAndGoesOnAfterSigterm) {
    plan.spp = 1 << 16;
    plan.chunk = 1 << 9;
    plan.make();
    Started first(Started::Program{{script(), "--jobs", "1", "--merge-every", "0.2"}});
    EXPECT_TRUE(eventually([&] { return std::filesystem::exists(merged("cornell")); })) << "no image before the end";
    // While it runs, another one is refused.
    const Finished second = run({script()});
    EXPECT_EQ(second.exit_code, 1);
    EXPECT_NE(second.err.find("is being rendered already"), std::string::npos) << second.err;
    EXPECT_EQ(first.end(SIGTERM), 143);
    EXPECT_FALSE(std::filesystem::exists(plan.folder + "/local.pid"));
    const nlohmann::json stopped = plan.status();
    EXPECT_GT(stopped["samples"], 0);
    EXPECT_LT(stopped["samples"], plan.spp) << "it had ended before it was stopped";
    // The next one is not refused: no task holds the lock any more.
    Started next(Started::Program{{script(), "--jobs", "1"}});
    EXPECT_TRUE(eventually([&] { return plan.status()["samples"] > stopped["samples"]; }));
    EXPECT_EQ(next.end(SIGTERM), 143);
}

TEST_F(LocalScript, IsStoppedByTheStopScript) {
    plan.spp = 1 << 16;
    plan.chunk = 1 << 9;
    plan.make();
    EXPECT_EQ(run({plan.folder + "/stop.sh"}).exit_code, 0) << "nothing runs";
    Started script_running(Started::Program{{script(), "--jobs", "2"}});
    EXPECT_TRUE(eventually([&] { return plan.status()["running"] == 2; }));
    EXPECT_EQ(run({plan.folder + "/stop.sh"}).exit_code, 0);
    EXPECT_EQ(script_running.wait(), 143);
    const nlohmann::json stopped = plan.status();
    EXPECT_EQ(stopped["running"], 0);
    EXPECT_GT(stopped["samples"], 0);
    // A number that is left of an earlier run may belong to another process by now.
    Started bystander(Started::Program{{"/bin/sleep", "60"}});
    write_text(plan.folder + "/local.pid", std::to_string(bystander.pid()) + "\n");
    EXPECT_EQ(run({plan.folder + "/stop.sh"}).exit_code, 0);
    EXPECT_EQ(bystander.end(SIGKILL), 128 + SIGKILL) << "it was ended";
}

TEST_F(LocalScript, EndsIfTasksFail) {
    const std::string copy = scene_copy(folder, "cornell");
    plan.scene = copy;
    plan.make();
    change_scene(copy);
    const Finished finished = run({script()});
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_NE(finished.err.find("the last round has rendered nothing"), std::string::npos) << finished.err;
}

TEST_F(LocalScript, RefusesUnknownOptions) {
    plan.make();
    EXPECT_EQ(run({script(), "--fast", "1"}).exit_code, 2);
}

} // namespace
} // namespace blush::test::TEST_FILE
