// The Farm panel's view of a plan: what it reads from the folder, and how it starts and stops the plan.
#include "app/commands/plan/render_part.h"
#include "app/commands/plan/task_log.h"
#include "app/farm/farm_jobs.h"
#include "app/farm/plan_state.h"
#include "tests/app/commands/plan/plan_support.h"
#include "tests/support/eventually.h"

#include <cstdlib>

namespace blush::test::TEST_FILE {
namespace {

using State = FarmPlan::State;

class PlanState : public testing::Test {
protected:
    ~PlanState() override { (void)stop_farm_plan(plan.folder); }

    TemporaryFolder folder;
    SmallPlan plan{.scene = scene_file("cornell"), .folder = folder / "it's a plan"};

    FarmPlan read() const { return read_farm_plan(plan.folder); }
    bool becomes(State state) const {
        return eventually([&] { return read().state == state; });
    }
    // More work than the test waits for.
    void make_long() {
        plan.spp = 1 << 16;
        plan.chunk = 1 << 9;
        plan.make();
    }
};

TEST_F(PlanState, SaysWhatANewPlanCosts) {
    plan.make();
    const FarmPlan read = this->read();
    EXPECT_EQ(read.state, State::stopped);
    EXPECT_EQ(read.fraction, 0);
    EXPECT_EQ(read.done, 0);
    EXPECT_GT(read.tasks, 0);
    EXPECT_EQ(read.looks, (std::vector<FarmLook>{{.name = "cornell", .samples = 0, .planned = plan.spp, .merged = 0, .error = ""}}));
    EXPECT_GT(read.seconds_here, 0);
    EXPECT_LE(read.seconds_knee, read.seconds_here);
    EXPECT_GT(read.disk_mib, 0);
    EXPECT_EQ(read.problem, "");
}

TEST_F(PlanState, FollowsARunToItsEnd) {
    plan.make();
    ASSERT_TRUE(start_farm_plan(plan.folder, {.processes = 2}));
    ASSERT_TRUE(becomes(State::finished));
    const FarmPlan read = this->read();
    EXPECT_EQ(read.done, read.tasks);
    EXPECT_EQ(read.looks[0].merged, plan.spp);
    EXPECT_EQ(read.looks[0].error.empty(), plan.status()["looks"][0]["error"].is_null());
    EXPECT_TRUE(std::filesystem::exists(merged_image(read, read.looks[0])));
    EXPECT_TRUE(read.failures.empty());
}

TEST_F(PlanState, StoppingIsNoFailure) {
    make_long();
    ASSERT_TRUE(start_farm_plan(plan.folder, {}));
    EXPECT_EQ(read().state, State::running) << "at once";
    ASSERT_TRUE(eventually([&] { return read().fraction > 0; }));
    ASSERT_TRUE(stop_farm_plan(plan.folder));
    ASSERT_TRUE(becomes(State::stopped));
    const FarmPlan stopped = read();
    EXPECT_EQ(stopped.failures, std::vector<std::string>());
    EXPECT_EQ(stopped.problem, "");
    EXPECT_LT(stopped.fraction, 1);
    ASSERT_TRUE(start_farm_plan(plan.folder, {}));
    EXPECT_TRUE(eventually([&] { return read().fraction > stopped.fraction; })) << "it does not go on";
}

// The last line of the log is that of the task or that of the script, by chance.
TEST_F(PlanState, StoppedTasksAreNoProblemInTheLog) {
    plan.make();
    const auto problem_after = [&](const std::string& line) {
        write_text(plan.folder + "/local.out", "Terminated\n" + line + "\n");
        return read().problem;
    };
    EXPECT_EQ(problem_after("blush: error: parts/cornell/0-511.exr: stopped by a signal with the samples 0:64 of 0:512"), "");
    EXPECT_EQ(problem_after("blush: error: cornell.gltf: cannot be read"), "cornell.gltf: cannot be read");
}

// A task may be stopped while it reads its scene, and before its first sample.
TEST_F(PlanState, StoppedTasksSayThatTheyWere) {
    plan.make();
    const RenderPlan read = *read_plan(plan.folder);
    const RenderRun run{.threads = 1, .quiet = true};
    const std::atomic<bool> stopped{true}, runs{false};
    const auto says_so = [](const Error& error) { return error.what.find(stopped_by_signal) != std::string::npos; };
    const Result<LoadedScene> unread = load_look(plan.folder, read, read.looks[0], run, stopped);
    ASSERT_FALSE(unread);
    EXPECT_TRUE(says_so(unread.error())) << unread.error().text();
    const Result<LoadedScene> loaded = load_look(plan.folder, read, read.looks[0], run, runs);
    ASSERT_TRUE(loaded) << loaded.error().text();
    const Result<Part> part = render_part(plan.folder, read, read.looks[0], *loaded, {0, 4}, run, stopped);
    ASSERT_FALSE(part);
    EXPECT_TRUE(says_so(part.error())) << part.error().text();
}

TEST_F(PlanState, SaysWhyAPlanHasStopped) {
    const std::string copy = scene_copy(folder, "cornell");
    plan.scene = copy;
    plan.make();
    change_scene(copy);
    ASSERT_TRUE(start_farm_plan(plan.folder, {}));
    ASSERT_TRUE(eventually([&] { return read().state == State::stopped && !read().failures.empty(); }));
    const FarmPlan read = this->read();
    EXPECT_NE(read.problem.find("the last round has rendered nothing"), std::string::npos) << read.problem;
    EXPECT_NE(read.failures[0].find("Task 1 of cornell failed: "), std::string::npos) << read.failures[0];
}

TEST_F(PlanState, DamagedPlansAreNamed) {
    plan.make();
    write_text(plan.folder + "/plan.json", "{");
    const FarmPlan read = this->read();
    EXPECT_EQ(read.state, State::unreadable);
    EXPECT_NE(read.problem.find("plan.json"), std::string::npos) << read.problem;
    EXPECT_EQ(read_farm_plan(folder / "none").state, State::unreadable);
}

// Slurm as the scripts see it, in PATH: `submitted` has the arguments of sbatch, `cancelled` those of scancel.
class FarmOfSlurm : public PlanState {
protected:
    FarmOfSlurm() {
        std::filesystem::create_directory(folder / "bin");
        program("sbatch", "echo \"$@\" >>'" + folder / "submitted" + "'; echo 17");
        program("scontrol", "exit 1");
        program("scancel", "echo \"$@\" >'" + folder / "cancelled" + "'");
        // Jobs of two folders, as long as they are not cancelled.
        program("squeue", "[ ! -e '" + folder / "cancelled" +
                              "' ] || exit 0\ncase $* in *%F*) echo \"17 $PWD\"; echo '18 /elsewhere' ;; *) cat '" + folder / "queue" +
                              "' ;; esac");
        setenv("PATH", (folder / "bin" + ":" + path_).c_str(), 1);
    }
    ~FarmOfSlurm() override { setenv("PATH", path_.c_str(), 1); }
    void program(const std::string& name, const std::string& lines) const {
        const std::string file = folder / ("bin/" + name);
        write_text(file, "#!/bin/sh\n" + lines + "\n");
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    }
    const std::string path_ = std::getenv("PATH");
};

TEST_F(FarmOfSlurm, SubmitsFollowsAndCancels) {
    EXPECT_TRUE(has_slurm());
    plan.make();
    write_text(folder / "queue", "/elsewhere\n");
    ASSERT_TRUE(start_farm_plan(plan.folder, {.where = FarmChoices::Where::slurm, .slurm_options = " --partition=farm  --nice=5"}));
    for (const std::string& line : lines_of(folder / "submitted"))
        EXPECT_NE(line.find("--partition=farm --nice=5"), std::string::npos) << line;
    EXPECT_EQ(read().state, State::stopped) << "the queue has jobs of others only";
    write_text(folder / "queue", "/elsewhere\n" + plan.folder + "\n");
    EXPECT_EQ(read().state, State::running);
    ASSERT_TRUE(stop_farm_plan(plan.folder));
    EXPECT_EQ(lines_of(folder / "cancelled"), std::vector<std::string>{"17"});
    EXPECT_EQ(read().state, State::stopped);
}

TEST_F(FarmOfSlurm, RefusedJobsAreReported) {
    plan.make();
    program("sbatch", "echo 'sbatch: error: invalid partition specified: farm' >&2; exit 1");
    const Result<void> started = start_farm_plan(plan.folder, {.where = FarmChoices::Where::slurm});
    ASSERT_FALSE(started);
    EXPECT_NE(started.error().text().find("invalid partition specified: farm"), std::string::npos) << started.error().text();
}

} // namespace
} // namespace blush::test::TEST_FILE
