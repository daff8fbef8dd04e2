// plan.json: what is written is read again; hostile files are errors.
#include "app/commands/plan/render_plan.h"
#include "tests/app/commands/plan/plan_support.h"

#include <random>

namespace blush::TEST_FILE {
namespace {

using test::expect_done;
using test::TemporaryFolder;

RenderPlan some_plan() {
    RenderPlan plan;
    plan.version = BLUSH_VERSION;
    plan.program = "'/usr/bin/blush'";
    plan.scenes = {{"/scenes/mug.gltf", "0123456789abcdef"}};
    plan.looks.push_back({.name = "mug.0001",
                          .words = {{"seed", "4"}},
                          .edits = R"({"format":1,"view":{"lens":{"aperture_radius":0.1}}})",
                          .lights_hash = "ff",
                          .settings = recommended_settings(),
                          .sequence = "mug"});
    plan.looks.push_back({.name = "mug.0002", .lights_hash = "ff", .settings = recommended_settings(), .finished = true});
    for (PlanLook& look : plan.looks) {
        look.settings.adaptive = false;
        look.settings.spp = 0;
        look.settings.width = 640;
    }
    plan.tasks = {{0, {0, 16}}, {1, {0, 16}}, {0, {16, 24}}};
    plan.chunk = 16;
    plan.spp = 24;
    plan.error = 0.5;
    plan.texture_mib = 100;
    plan.layers = "albedo,film";
    plan.costs = {1, 2, 3, 4, 5, 6};
    plan.frames_per_second = 25;
    return plan;
}

TEST(PlanFile, IsReadAsItWasWritten) {
    const TemporaryFolder folder;
    const RenderPlan plan = some_plan();
    ASSERT_TRUE(write_plan(folder.path(), plan));
    const Result<RenderPlan> read = read_plan(folder.path());
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->program, plan.program);
    EXPECT_EQ(read->scenes[0].file, plan.scenes[0].file);
    ASSERT_EQ(read->looks.size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(read->looks[i].name, plan.looks[i].name);
        EXPECT_EQ(read->looks[i].settings, plan.looks[i].settings);
        EXPECT_EQ(read->looks[i].edits, plan.looks[i].edits);
        EXPECT_EQ(read->looks[i].words, plan.looks[i].words);
        EXPECT_EQ(read->looks[i].sequence, plan.looks[i].sequence);
        EXPECT_EQ(read->looks[i].finished, plan.looks[i].finished);
        EXPECT_EQ(read->recipe(read->looks[i]), plan.recipe(plan.looks[i]));
    }
    ASSERT_EQ(read->tasks.size(), 3u);
    EXPECT_EQ(read->tasks[2].samples, (SampleSpan{16, 24}));
    EXPECT_EQ(read->costs, plan.costs);
    EXPECT_EQ(read->error, 0.5);
    EXPECT_EQ(read->texture_mib, 100);
    EXPECT_EQ(read->layers, "albedo,film");
    EXPECT_EQ(read->frames_per_second, 25);
}

TEST(PlanFile, RecipeIsThatOfThePixels) {
    const RenderPlan plan = some_plan();
    PlanLook look = plan.looks[0];
    const std::string recipe = plan.recipe(look);
    look.name = "other";
    look.words.clear();
    EXPECT_EQ(plan.recipe(look), recipe);
    look.settings.seed = 1;
    EXPECT_NE(plan.recipe(look), recipe);
    look = plan.looks[0];
    look.lights_hash = "fe";
    EXPECT_NE(plan.recipe(look), recipe);
    look = plan.looks[0];
    look.edits.clear();
    EXPECT_NE(plan.recipe(look), recipe);
}

TEST(PlanFile, ErrorsSayWhere) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_plan(folder.path(), some_plan()));
    const nlohmann::ordered_json good = nlohmann::ordered_json::parse(test::text_of(folder / "plan.json"));
    const std::tuple<const char*, nlohmann::ordered_json, const char*> wrong[] = {
        {"/format", 2, "format"},
        {"/version", "9.9.9", "was made by blush 9.9.9"},
        {"/looks/0/name", "../x", "looks[0].name"},
        {"/looks/0/name", "a/b", "looks[0].name"},
        {"/looks/0/name", ".hidden", "looks[0].name"},
        {"/looks/0/name", "mug.0002", "looks[1].name"},
        {"/looks/0/name", "", "looks[0].name"},
        {"/looks/0/sequence", "../../x", "looks[0].sequence"},
        {"/looks/0/scene", 1, "looks[0].scene"},
        {"/looks/0/scene", -1, "looks[0].scene"},
        {"/looks/0/settings/adaptive", true, "looks[0].settings"},
        {"/adaptive", "on", "adaptive"},
        {"/adaptive", true, "looks[0].settings"},
        {"/looks/0/allocation", "00ff", "looks[0].allocation"},
        {"/looks/0/settings/size", "0x0", "looks[0].settings"},
        {"/looks/0/edits", "text", "looks[0].edits"},
        {"/tasks/1/look", "missing-look", "tasks[1].look"},
        {"/tasks/1/samples", {4, 4}, "tasks[1].samples"},
        {"/tasks/1/samples", {-4, 4}, "tasks[1].samples"},
        {"/tasks/1/samples", {0, 9e18}, "tasks[1].samples"},
        {"/tasks/1/samples", {0, 4, 8}, "tasks[1].samples"},
        {"/chunk", 0, "chunk"},
        {"/spp", -1, "spp"},
        {"/error", -1, "error"},
        {"/fps", 0, "fps"},
        {"/layers", "albedo", "layers"},
        {"/layers", "filmy", "layers"},
        {"/measured/start", "a", "measured.start"},
        {"/scenes", nlohmann::ordered_json::array(), "scenes"},
        {"/looks", nlohmann::ordered_json::array(), "looks"},
        {"/view", 1, "view"},
    };
    for (const auto& [path, value, where] : wrong) {
        nlohmann::ordered_json changed = good;
        changed[nlohmann::ordered_json::json_pointer(path)] = value;
        test::write_text(folder / "plan.json", changed.dump());
        const Result<RenderPlan> read = read_plan(folder.path());
        ASSERT_FALSE(read) << path;
        EXPECT_NE(read.error().text().find(where), std::string::npos) << path << ": " << read.error().text();
    }
}

// The allocation is decided from the halves of the pilot: a task across their ends would be refused after it was rendered.
TEST(PlanFile, AdaptiveTasksEndAtTheHalvesOfThePilot) {
    const TemporaryFolder folder;
    RenderPlan plan = some_plan();
    plan.adaptive = true;
    for (PlanLook& look : plan.looks) look.settings.adaptive = true;
    plan.looks[1].allocation = "00ff";
    plan.tasks = {{0, {0, 8}}, {0, {8, 16}}, {1, {3, 8}}, {1, {16, 24}}};
    ASSERT_TRUE(write_plan(folder.path(), plan));
    const Result<RenderPlan> read = read_plan(folder.path());
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_TRUE(read->adaptive && read->looks[0].settings.adaptive && read->in_rounds());
    EXPECT_EQ(read->looks[1].allocation, "00ff");
    for (const SampleSpan across : {SampleSpan{0, 9}, SampleSpan{7, 16}, SampleSpan{15, 17}}) {
        plan.tasks[1].samples = across;
        ASSERT_TRUE(write_plan(folder.path(), plan));
        const Result<RenderPlan> refused = read_plan(folder.path());
        ASSERT_FALSE(refused) << across.first;
        EXPECT_NE(refused.error().text().find("tasks[1].samples"), std::string::npos) << refused.error().text();
    }
}

TEST(PlanFile, HostileOnesAreErrors) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_plan(folder.path(), some_plan()));
    const std::string good = test::text_of(folder / "plan.json");
    std::mt19937 random(9);
    int read = 0;
    for (int i = 0; i < 2000; ++i) {
        std::string text = good;
        for (unsigned k = random() % 4; k < 4; ++k) {
            const size_t at = random() % text.size();
            switch (random() % 3) {
            case 0: text[at] = "{}[]\",:0e-\xff\\n9"[random() % 15]; break;
            case 1: text.erase(at, 1 + random() % 20); break;
            default: text.insert(at, text.substr(random() % text.size(), random() % 40));
            }
        }
        test::write_text(folder / "plan.json", text);
        const Result<RenderPlan> plan = read_plan(folder.path());
        if (!plan) continue;
        ++read;
        for (const PlanLook& look : plan->looks) EXPECT_TRUE(is_safe_name(look.name)) << look.name;
        for (const PlanTask& task : plan->tasks) EXPECT_TRUE(task.look < plan->looks.size() && task.samples.first < task.samples.last);
    }
    EXPECT_GT(read, 0) << "all changes broke the file: nothing was tested behind the parser";
    test::write_text(folder / "plan.json", "{\"looks\":" + std::string(200000, '[') + std::string(200000, ']') + "}");
    EXPECT_FALSE(read_plan(folder.path()));
}

// A plan from elsewhere cannot make a worker write where a link leads.
TEST(PlanFile, LinksOutOfTheFolderAreRefused) {
    const TemporaryFolder folder, outside;
    const test::SmallPlan plan{.scene = test::scene_file("cornell"), .folder = folder / "plan"};
    plan.make();
    std::filesystem::remove(plan.folder + "/parts");
    std::filesystem::create_directory_symlink(outside.path(), plan.folder + "/parts");
    const test::Finished finished = plan.run(1);
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_NE(finished.err.find("leads out of the folder"), std::string::npos) << finished.err;
    EXPECT_TRUE(std::filesystem::is_empty(outside.path()));
    // Nor where one of its files is a link.
    std::filesystem::remove(plan.folder + "/parts");
    expect_done(plan.task(1));
    test::write_text(outside / "precious", "precious");
    for (const char* file : {"/parts/cornell/0000000016-0000000032.exr", "/merged/cornell.png", "/contact-sheet.png", "/missing.txt"}) {
        std::filesystem::remove(plan.folder + file);
        std::filesystem::create_symlink(outside / "precious", plan.folder + file);
        const bool is_part = std::string(file).starts_with("/parts");
        using Commands = std::vector<test::Arguments>;
        const Commands commands =
            is_part ? Commands{plan.task(2)}
                    : Commands{{"plan", "merge", plan.folder, "--partial", "--quiet"}, {"plan", "resume", plan.folder, "--quiet"}};
        for (const test::Arguments& writes : commands) {
            const test::Finished refused = test::blush(writes);
            EXPECT_EQ(refused.exit_code, 1) << file;
            EXPECT_NE(refused.err.find("is a link"), std::string::npos) << refused.err;
        }
        EXPECT_EQ(test::text_of(outside / "precious"), "precious") << file;
        std::filesystem::remove(plan.folder + file);
    }
}

} // namespace
} // namespace blush::TEST_FILE
