// Workers of a plan: whatever happens to them, no sample is lost, none counts twice, and the merged image is that of one process.
#include "tests/app/commands/plan/plan_support.h"

#include <random>

namespace blush::TEST_FILE {
namespace {

using std::chrono::milliseconds;
using test::Arguments;
using test::expect_done;
using test::Finished;
using test::scene_file;
using test::SmallPlan;
using test::Started;
using test::TemporaryFolder;

void expect_refused(const Finished& finished, const std::string& words) {
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_TRUE(test::is_one_line(finished.err)) << finished.err;
    EXPECT_NE(finished.err.find(words), std::string::npos) << finished.err;
}

// Neither temporary files nor anything else without a meaning.
void expect_only_parts(const SmallPlan& plan, const std::string& look) {
    for (const auto& entry : std::filesystem::directory_iterator(plan.folder + "/parts/" + look)) {
        const std::string name = entry.path().filename().string();
        EXPECT_EQ(name.size(), std::string("0000000000-0000000000.json").size() - (name.ends_with(".exr") ? 1 : 0)) << name;
    }
}

void expect_merged_as_one_process(const SmallPlan& plan, const TemporaryFolder& folder) {
    expect_done({"plan", "merge", plan.folder, "--quiet"});
    plan.render_whole(folder / "whole.exr");
    test::expect_same_pixels(plan.folder + "/merged/cornell.exr", folder / "whole.exr");
}

TEST(PlanTasks, OfTheListInAnyOrderAreTheBitsOfOneProcess) {
    const TemporaryFolder folder;
    // A name that a shell would take apart.
    const SmallPlan plan{.scene = scene_file("cornell"), .folder = folder / "it's $a \"plan\"", .spp = 72};
    plan.make();
    std::vector<std::string> commands = test::lines_of(plan.folder + "/commands.txt");
    ASSERT_EQ(commands.size(), 5u) << "four chunks of 16 samples and one of 8";
    std::shuffle(commands.begin(), commands.end(), std::mt19937(11));
    for (const std::string& command : commands) {
        const Finished finished = test::shell(command + " --quiet");
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
    }
    for (const std::string& command : test::lines_of(plan.folder + "/merge.txt")) EXPECT_EQ(test::shell(command).exit_code, 0);
    plan.render_whole(folder / "whole.exr");
    test::expect_same_pixels(plan.folder + "/merged/cornell.exr", folder / "whole.exr");
    const nlohmann::json status = plan.status();
    EXPECT_EQ(status["done"], 5);
    EXPECT_EQ(status["samples"], 72);
    EXPECT_EQ(status["looks"][0]["merged"], 72);
    EXPECT_TRUE(status["failed"].empty()) << status["failed"];
}

TEST(PlanTasks, RunAgainIsFree) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = test::scene_copy(folder, "cornell"), .folder = folder / "plan"};
    plan.make();
    expect_done(plan.task(2));
    const std::string part = plan.part("cornell", "0000000016-0000000032");
    const auto time = std::filesystem::last_write_time(part);
    std::filesystem::remove(plan.scene); // not even the scene is read
    const nlohmann::json again = test::blush_json({"plan", "run", plan.folder, "2"});
    EXPECT_EQ(again["rendered"][0], again["rendered"][1]) << again;
    EXPECT_EQ(std::filesystem::last_write_time(part), time);
}

TEST(PlanTasks, ReplacePartsThatAreNotTheirs) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = scene_file("cornell"), .folder = folder / "plan"},
        other{.scene = scene_file("cornell"), .folder = folder / "other"};
    plan.make();
    other.make({"--seed", "7"});
    for (int64_t task = 1; task <= plan.tasks(); ++task) {
        expect_done(plan.task(task));
        expect_done(other.task(task));
    }
    const auto replaced = std::filesystem::copy_options::overwrite_existing;
    // Other settings, with and without their record; other samples; half a file; no image; a record of nothing.
    for (const auto& entry : std::filesystem::directory_iterator(other.folder + "/parts/cornell"))
        std::filesystem::copy_file(entry.path(), plan.folder + "/parts/cornell/" + entry.path().filename().string(), replaced);
    EXPECT_EQ(plan.status()["done"], 0);
    expect_done(plan.task(1));
    std::filesystem::copy_file(other.part("cornell", "0000000016-0000000032"), plan.part("cornell", "0000000000-0000000016"), replaced);
    std::filesystem::remove(plan.folder + "/parts/cornell/0000000000-0000000016.json");
    EXPECT_EQ(plan.status()["done"], 0);
    for (int64_t task = 1; task <= plan.tasks(); ++task) expect_done(plan.task(task));
    EXPECT_EQ(plan.status()["done"], 4);
    std::filesystem::resize_file(plan.part("cornell", "0000000016-0000000032"), 20000);
    test::write_text(plan.part("cornell", "0000000032-0000000048"), "not an image");
    std::filesystem::remove(plan.part("cornell", "0000000048-0000000064"));
    EXPECT_EQ(plan.status()["done"], 1);
    for (int64_t task = 1; task <= plan.tasks(); ++task) expect_done(plan.task(task));
    expect_merged_as_one_process(plan, folder);
}

TEST(PlanTasks, RefuseAnotherSceneAndVersion) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = test::scene_copy(folder, "cornell"), .folder = folder / "plan"};
    plan.make();
    const std::string scene = test::text_of(plan.scene);
    test::change_scene(plan.scene);
    expect_refused(plan.run(1), "cornell.gltf: is not the scene of the plan");
    EXPECT_NE(plan.status()["failed"][0]["line"].get<std::string>().find("is not the scene"), std::string::npos);
    test::write_text(plan.scene, scene);

    const std::string json = test::text_of(plan.folder + "/plan.json");
    nlohmann::ordered_json older = nlohmann::ordered_json::parse(json);
    older["version"] = "0.0.1";
    test::write_text(plan.folder + "/plan.json", older.dump());
    expect_refused(plan.run(1), "was made by blush 0.0.1");
    test::write_text(plan.folder + "/plan.json", json);
    EXPECT_TRUE(std::filesystem::is_empty(plan.folder + "/parts/cornell"));
    expect_done(plan.task(1));
    EXPECT_EQ(plan.status()["done"], 1);
}

TEST(PlanTasks, RefuseAnotherEnvironmentFile) {
    const TemporaryFolder folder;
    const std::string map = folder / "map.hdr";
    std::filesystem::copy_file(BLUSH_ASSETS "/environments/studio.hdr", map);
    const SmallPlan plan{.scene = scene_file("cornell"), .folder = folder / "plan"};
    plan.make({"--env", map});
    std::string bytes = test::text_of(map);
    for (size_t i = bytes.size() / 2; i < bytes.size() / 2 + 64; ++i) bytes[i] = 1;
    test::write_text(map, bytes);
    const Finished finished = plan.run(1);
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_TRUE(test::is_one_line(finished.err)) << finished.err;
}

// Preemption: the samples so far are kept, and the same command renders the rest.
TEST(PlanTasks, StoppedBySigtermLoseNothing) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = scene_file("cornell"), .folder = folder / "plan", .spp = 8192, .chunk = 8192};
    plan.make();
    std::mt19937 random(3);
    int64_t kept = 0;
    size_t shortened = 0;
    for (int i = 0; i < 40 && plan.status()["done"] == 0; ++i) {
        Started worker(plan.task(1));
        const int code = worker.end_after(milliseconds(200 + random() % 1200), SIGTERM);
        EXPECT_TRUE(code == 0 || code == 1 || code == 128 + SIGTERM) << code;
        const int64_t now = plan.status()["samples"];
        EXPECT_GE(now, kept);
        if (now > kept) ++shortened;
        kept = now;
    }
    EXPECT_GE(shortened, 2u);
    expect_only_parts(plan, "cornell");
    expect_done(plan.task(1));
    expect_merged_as_one_process(plan, folder);
}

TEST(PlanTasks, StopWithALineThatSaysWhatIsThere) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = scene_file("cornell"), .folder = folder / "plan", .spp = 1 << 20, .chunk = 1 << 20};
    plan.make();
    bool sent = false; // the second one would end it at once
    const test::RunOptions stop{.on_stderr = [&](const std::string& err, int pid) {
        if (!std::exchange(sent, sent || err.find(" spp") != std::string::npos) && sent) kill(pid, SIGTERM);
    }};
    const Finished stopped = test::blush({"plan", "run", plan.folder, "1"}, stop);
    EXPECT_EQ(stopped.exit_code, 1);
    EXPECT_NE(stopped.err.find("stopped by a signal with the samples 0:"), std::string::npos) << stopped.err;
    const nlohmann::json status = plan.status();
    EXPECT_GT(status["samples"], 0);
    EXPECT_LT(status["samples"], 1 << 20);
    EXPECT_NE(status["failed"][0]["line"].get<std::string>().find("stopped by a signal"), std::string::npos);
    // What there is can be merged, but is not by itself.
    EXPECT_EQ(test::blush({"plan", "merge", plan.folder}).exit_code, 1);
    EXPECT_FALSE(std::filesystem::exists(plan.folder + "/merged/cornell.exr"));
    expect_done({"plan", "merge", plan.folder, "--partial", "--quiet"});
    EXPECT_EQ(plan.status()["looks"][0]["merged"], status["samples"]);
}

TEST(PlanTasks, TwoWorkersAtOnceMakeOnePart) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = scene_file("cornell"), .folder = folder / "plan", .spp = 2048, .chunk = 1024};
    plan.make();
    Started a(plan.task(1)), b(plan.task(1)), c(plan.task(2));
    EXPECT_EQ(a.wait(), 0);
    EXPECT_EQ(b.wait(), 0);
    EXPECT_EQ(c.wait(), 0);
    expect_only_parts(plan, "cornell");
    expect_merged_as_one_process(plan, folder);
}

TEST(PlanTasks, OnAFullDiskFailAndLeaveNothing) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = scene_file("cornell"), .folder = folder / "plan"};
    plan.make();
    EXPECT_EQ(Started(plan.task(1), 4096).wait(), 1);
    EXPECT_TRUE(std::filesystem::is_empty(plan.folder + "/parts/cornell"));
    const nlohmann::json status = plan.status();
    EXPECT_EQ(status["samples"], 0);
    EXPECT_NE(status["failed"][0]["line"].get<std::string>().find("error: "), std::string::npos) << status["failed"];
    for (int64_t task = 1; task <= plan.tasks(); ++task) expect_done(plan.task(task));
    expect_merged_as_one_process(plan, folder);
}

TEST(PlanTasks, KilledOnesAreReported) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = scene_file("cornell"), .folder = folder / "plan", .spp = 1 << 20, .chunk = 1 << 20};
    plan.make();
    Started worker(plan.task(1));
    while (test::lines_of(plan.folder + "/logs/000001.log").empty()) std::this_thread::sleep_for(milliseconds(5));
    EXPECT_EQ(plan.status()["running"], 1);
    EXPECT_EQ(worker.end(SIGKILL), 128 + SIGKILL);
    const nlohmann::json status = plan.status();
    EXPECT_EQ(status["running"], 0);
    EXPECT_NE(status["failed"][0]["line"].get<std::string>().find("ended without a word: begun on "), std::string::npos)
        << status["failed"];
}

// One fault of a kind that farms have. Returns without knowing what it did to the task.
void inject_fault(const SmallPlan& plan, std::mt19937& random) {
    const auto below = [&](uint64_t n) { return int64_t(random() % n); };
    const int64_t task = 1 + below(uint64_t(plan.tasks()));
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(plan.folder + "/parts"))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    switch (below(7)) {
    case 0: Started(plan.task(task)).end_after(milliseconds(below(700)), SIGKILL); break;
    case 1:
    case 2: Started(plan.task(task)).end_after(milliseconds(below(1200)), SIGTERM); break;
    case 3: Started(plan.task(task), uint64_t(1 + below(60000))).wait(); break;
    case 4: {
        Started a(plan.task(task)), b(plan.task(task));
        a.end_after(milliseconds(below(1200)), SIGTERM);
        b.end(below(2) ? SIGTERM : SIGKILL);
        break;
    }
    case 5: // half written by a file system that crashed
        if (!files.empty()) {
            const auto& file = files[size_t(below(files.size()))];
            std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
        }
        break;
    default: // bits that fell over, in a file whose size is right
        if (!files.empty()) {
            const std::string file = files[size_t(below(files.size()))].string();
            std::string bytes = test::text_of(file);
            for (size_t i = bytes.size() / 2; i < std::min(bytes.size(), bytes.size() / 2 + 200); ++i) bytes[i] = char(random());
            test::write_text(file, bytes);
        }
    }
}

TEST(PlanTasks, AHundredFaultsCostNoSample) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = scene_file("cornell"), .folder = folder / "plan", .spp = 4096, .chunk = 1024};
    plan.make();
    std::mt19937 random(20);
    for (int i = 0; i < 100; ++i) inject_fault(plan, random);
    // As a farm does: what is missing, then the merge, which finds damaged parts.
    for (int round = 0; round < 10; ++round) {
        expect_done({"plan", "resume", plan.folder, "--quiet"});
        for (const std::string& command : test::lines_of(plan.folder + "/missing.txt"))
            EXPECT_EQ(test::shell(command + " --quiet").exit_code, 0);
        if (test::blush({"plan", "merge", plan.folder, "--quiet"}).exit_code == 0) break;
    }
    const nlohmann::json status = plan.status();
    EXPECT_EQ(status["samples"], 4096);
    EXPECT_EQ(status["looks"][0]["merged"], 4096);
    plan.render_whole(folder / "whole.exr");
    test::expect_same_pixels(plan.folder + "/merged/cornell.exr", folder / "whole.exr");
}

} // namespace
} // namespace blush::TEST_FILE
