// `blush plan`: what it writes, for which looks, and how it is used wrongly.
#include "app/commands/plan/plan_files.h"
#include "tests/app/commands/plan/plan_support.h"

#include <set>

namespace blush::TEST_FILE {
namespace {

using test::Arguments;
using test::blush;
using test::expect_done;
using test::Finished;
using test::scene_file;
using test::SmallPlan;
using test::TemporaryFolder;

void run_all(const SmallPlan& plan) {
    for (int64_t task = 1; task <= plan.tasks(); ++task) expect_done(plan.task(task));
    const Finished merged = blush({"plan", "merge", plan.folder, "--quiet"});
    EXPECT_EQ(merged.exit_code, 0) << merged.err;
}

std::set<std::string> look_names(const SmallPlan& plan) {
    std::set<std::string> names;
    const nlohmann::json json = test::json_of(plan.folder + "/plan.json");
    for (const auto& look : json["looks"]) names.insert(look["name"]);
    return names;
}

TEST(Plan, ExplainsItself) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = scene_file("cornell"), .folder = folder / "plan"};
    plan.make();
    const nlohmann::json json = test::json_of(plan.folder + "/plan.json");
    EXPECT_EQ(json["adaptive"], false);
    EXPECT_EQ(json["chunk"], 16);
    EXPECT_EQ(json["tasks"][1], nlohmann::json({{"task", 2}, {"look", "cornell"}, {"samples", {16, 32}}}));
    EXPECT_EQ(json["scenes"][0]["hash"].get<std::string>().size(), 16u);
    for (const char* cost : {"start", "sample", "write", "read", "memory_mib", "part_mib"}) EXPECT_GT(json["measured"][cost], 0) << cost;
    EXPECT_EQ(json["scaling"]["table"].front()["workers"], 1);
    EXPECT_EQ(json["scaling"]["table"].back()["workers"], 10000);
    EXPECT_EQ(test::shell("sh -n '" + plan.folder + "/submit-slurm.sh' && sh -n '" + plan.folder + "/slurm-job.sh' && sh -n '" +
                          plan.folder + "/run-local.sh'")
                  .exit_code,
              0);
    EXPECT_NE(test::text_of(plan.folder + "/README.txt").find("commands.txt"), std::string::npos);
    // A second plan does not take its place.
    const Finished again = blush({"plan", plan.scene, "-o", plan.folder});
    EXPECT_EQ(again.exit_code, 1);
    EXPECT_NE(again.err.find("has a plan already"), std::string::npos) << again.err;
}

TEST(Plan, ChoosesTheChunkFromItsMeasurements) {
    const TemporaryFolder folder;
    expect_done({"plan", scene_file("cornell"), "-o", folder / "plan", "--quiet", "--size", "40x24", "--spp", "65536"});
    const nlohmann::json json = test::json_of(folder / "plan/plan.json");
    const int64_t chunk = json["chunk"];
    EXPECT_EQ(chunk & (chunk - 1), 0);
    EXPECT_TRUE(chunk >= 65536 || json["scaling"]["table"][0]["efficiency"] > 1 / 1.03) << json["scaling"].dump();
}

// Each is exactly what `blush render` makes with its options.
TEST(Plan, LooksAreThoseOfTheirOptions) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = scene_file("card-and-mug"), .folder = folder / "plan", .spp = 8, .chunk = 4};
    test::write_text(folder / "looks.json", R"({"looks": [{"name": "grey", "set": {"env": "constant=0.5,0.5,0.5"}},
                                                {"name": "lens", "set": {"aperture": 0.02, "max-bounces": 2}}],
                                               "matrix": {"seed": [0, 3]}})");
    plan.make({"--looks", folder / "looks.json", "--layers", "albedo"});
    EXPECT_EQ(look_names(plan),
              (std::set<std::string>{"card-and-mug-grey-0", "card-and-mug-grey-3", "card-and-mug-lens-0", "card-and-mug-lens-3"}));
    run_all(plan);
    plan.render_whole(folder / "grey.exr", {"--env", "constant=0.5,0.5,0.5", "--seed", "3"});
    plan.render_whole(folder / "lens.exr", {"--aperture", "0.02", "--max-bounces", "2"});
    test::expect_same_pixels(plan.folder + "/merged/card-and-mug-grey-3.exr", folder / "grey.exr");
    test::expect_same_pixels(plan.folder + "/merged/card-and-mug-lens-0.exr", folder / "lens.exr");
    EXPECT_TRUE(read_layers(plan.folder + "/merged/card-and-mug-lens-0.exr")->find("albedo.R"));
    for (const char* file : {"/contact-sheet.png", "/contact-sheet.html", "/merged/card-and-mug-grey-0.png"})
        EXPECT_TRUE(std::filesystem::exists(plan.folder + file)) << file;
    EXPECT_NE(test::text_of(plan.folder + "/contact-sheet.html").find("merged/card-and-mug-lens-3.png"), std::string::npos);
}

// A copy of the Cornell box with a second camera, two variants of the left wall, and a block that moves.
std::string scene_with_choices(const TemporaryFolder& folder) {
    const std::string file = test::scene_copy(folder, "cornell");
    nlohmann::json scene = test::json_of(file);
    nlohmann::json camera = scene["nodes"][8];
    camera["name"] = "near / left";
    camera["translation"] = {0.2, 0.3, -0.6};
    scene["nodes"].push_back(camera);
    scene["scenes"][0]["nodes"].push_back(9);
    scene["extensionsUsed"].push_back("KHR_materials_variants");
    scene["extensions"]["KHR_materials_variants"]["variants"] = {{
                                                                     {"name", "Green"},
                                                                 },
                                                                 {{"name", "White"}}};
    scene["meshes"][3]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {0}}},
                                                                                               {{"material", 0}, {"variants", {1}}}};
    // Times 0 and 1; positions (0, 0, 0) and (0.5, 0.2, 0).
    const size_t buffer = scene["buffers"].size(), view = scene["bufferViews"].size(), accessor = scene["accessors"].size();
    scene["buffers"].push_back(
        {{"byteLength", 32}, {"uri", "data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAAAAAAAA/zcxMPgAAAAA="}});
    scene["bufferViews"].push_back({{"buffer", buffer}, {"byteOffset", 0}, {"byteLength", 8}});
    scene["bufferViews"].push_back({{"buffer", buffer}, {"byteOffset", 8}, {"byteLength", 24}});
    scene["accessors"].push_back(
        {{"bufferView", view}, {"componentType", 5126}, {"count", 2}, {"type", "SCALAR"}, {"min", {0}}, {"max", {1}}});
    scene["accessors"].push_back({{"bufferView", view + 1}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}});
    scene["animations"] = {{{"name", "slide"},
                            {"samplers", {{{"input", accessor}, {"output", accessor + 1}}}},
                            {"channels", {{{"sampler", 0}, {"target", {{"node", 6}, {"path", "translation"}}}}}}}};
    test::write_text(file, scene.dump());
    return file;
}

TEST(Plan, CamerasVariantsAndFramesAreLooks) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = scene_with_choices(folder), .folder = folder / "plan", .spp = 4, .chunk = 4};
    plan.make({"--cameras", "all", "--variants", "White,0", "--frames", "0:10:5", "--fps", "10"});
    const std::set<std::string> names = look_names(plan);
    EXPECT_EQ(names.size(), 2u * 2 * 3);
    EXPECT_TRUE(names.contains("cornell-near---left-White.0005")) << *names.begin();
    run_all(plan);
    plan.render_whole(folder / "whole.exr",
                      {"--camera", "1", "--material-variant", "White", "--animation", "slide", "--animation-time", "0.5"});
    test::expect_same_pixels(plan.folder + "/merged/cornell-near---left-White.0005.exr", folder / "whole.exr");
    std::set<std::vector<float>> images;
    for (const std::string& name : names) images.insert(read_layers(plan.folder + "/merged/" + name + ".exr")->find("G")->values);
    EXPECT_EQ(images.size(), names.size()) << "all are different images";
    EXPECT_EQ(test::json_of(plan.folder + "/plan.json")["looks"][0]["sequence"], "cornell-published-camera-White");
}

TEST(Plan, SeveralScenesWithStudioLightKeepTheirNamesApart) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "other");
    for (const char* ending : {".gltf", ".bin"})
        std::filesystem::copy_file(std::filesystem::path(scene_file("furnace")).replace_extension(ending),
                                   folder / (std::string("other/furnace") + ending));
    const SmallPlan plan{.scene = scene_file("furnace"), .folder = folder / "plan", .spp = 4, .chunk = 4};
    plan.make({folder / "other/furnace.gltf", scene_file("cornell")});
    EXPECT_EQ(look_names(plan), (std::set<std::string>{"furnace", "furnace-2", "cornell"}));
    run_all(plan);
}

TEST(Plan, TurntableTurnsTheCamera) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = scene_file("card-and-mug"), .folder = folder / "plan", .spp = 4, .chunk = 4};
    plan.make({"--turntable", "4"});
    EXPECT_EQ(look_names(plan),
              (std::set<std::string>{"card-and-mug.0000", "card-and-mug.0001", "card-and-mug.0002", "card-and-mug.0003"}));
    run_all(plan);
    plan.render_whole(folder / "whole.exr");
    test::expect_same_pixels(plan.folder + "/merged/card-and-mug.0000.exr", folder / "whole.exr");
    EXPECT_NE(read_layers(plan.folder + "/merged/card-and-mug.0001.exr")->find("R")->values,
              read_layers(plan.folder + "/merged/card-and-mug.0003.exr")->find("R")->values);
    const bool ffmpeg = test::shell("command -v ffmpeg").exit_code == 0;
    EXPECT_EQ(std::filesystem::exists(plan.folder + "/merged/card-and-mug.mp4"), ffmpeg);
}

// A snapshot is rendered again as it is, with its edits, under a plan's own number of samples.
TEST(Plan, SnapshotsAreLooks) {
    const TemporaryFolder folder;
    const std::string scene = test::scene_copy(folder, "card-and-mug");
    const Arguments settings{"--size", "40x24", "--env", "constant=0.1,0.2,0.9", "--max-bounces", "3", "--quiet"};
    expect_done(test::joined({"render", scene, "-o", folder / "view.exr", "--spp", "2", "--layers", "film"}, settings));
    const SmallPlan plan{.scene = scene, .folder = folder / "plan", .spp = 8};
    expect_done({"plan", "-o", plan.folder, "--snapshots", folder / "view.exr", "--spp", "8", "--chunk", "8", "--quiet"});
    EXPECT_EQ(look_names(plan), std::set<std::string>{"view"});
    run_all(plan);
    expect_done(test::joined({"render", scene, "-o", folder / "whole.exr", "--samples", "0:8"}, settings));
    test::expect_same_pixels(plan.folder + "/merged/view.exr", folder / "whole.exr");
    // Its scene has changed since.
    std::filesystem::copy_file(scene_file("cornell"), scene, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::copy_file(std::filesystem::path(scene_file("cornell")).replace_extension(".bin"), folder / "cornell.bin");
    const Finished changed = blush({"plan", "-o", folder / "plan2", "--snapshots", folder / "view.exr", "--quiet"});
    EXPECT_EQ(changed.exit_code, 1);
    EXPECT_NE(changed.err.find("another version of"), std::string::npos) << changed.err;
}

// Options and combinations begin with the edits, the camera and the settings of the snapshot.
TEST(Plan, SnapshotsCanBeTurnedAndOverridden) {
    const TemporaryFolder folder;
    const std::string scene = test::scene_copy(folder, "card-and-mug");
    const Arguments settings{"--env", "constant=0.1,0.2,0.9", "--seed", "7", "--quiet"};
    expect_done(test::joined({"render", scene, "-o", folder / "view.exr", "--spp", "2", "--size", "80x48", "--layers", "film"}, settings));
    const SmallPlan plan{.scene = scene, .folder = folder / "plan", .spp = 8};
    expect_done({"plan", "-o", plan.folder, "--snapshots", folder / "view.exr", "--spp", "8", "--chunk", "8", "--size", "40x",
                 "--max-bounces", "2", "--turntable", "2", "--quiet"});
    EXPECT_EQ(look_names(plan), (std::set<std::string>{"view.0000", "view.0001"}));
    run_all(plan);
    expect_done(
        test::joined({"render", scene, "-o", folder / "whole.exr", "--samples", "0:8", "--size", "40x24", "--max-bounces", "2"}, settings));
    test::expect_same_pixels(plan.folder + "/merged/view.0000.exr", folder / "whole.exr");
    EXPECT_NE(read_layers(plan.folder + "/merged/view.0001.exr")->find("R")->values, read_layers(folder / "whole.exr")->find("R")->values);
}

// The folder alone is enough, wherever it is then.
TEST(Plan, GathersItsScenes) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "here");
    std::filesystem::create_directory(folder / "here/data");
    for (const char* name : {"cornell.gltf", "cornell.bin"})
        std::filesystem::copy_file(std::filesystem::path(scene_file("cornell")).replace_filename(name),
                                   folder / (std::string("here/") + name));
    nlohmann::json scene = test::json_of(folder / "here/cornell.gltf");
    scene["buffers"][0]["uri"] = "data/box%20of%20Cornell.bin";
    test::write_text(folder / "here/cornell.gltf", scene.dump());
    std::filesystem::rename(folder / "here/cornell.bin", folder / "here/data/box of Cornell.bin");
    std::filesystem::copy_file(BLUSH_ASSETS "/environments/studio.hdr", folder / "here/map.hdr");
    SmallPlan plan{.scene = folder / "here/cornell.gltf", .folder = folder / "plan", .spp = 4, .chunk = 4};
    const Arguments environment{"--env", folder / "here/map.hdr,rotate=20"};
    plan.render_whole(folder / "whole.exr", environment);
    plan.make(test::joined(environment, {"--gather"}));
    std::filesystem::remove_all(folder / "here");
    std::filesystem::rename(plan.folder, folder / "there");
    plan.folder = folder / "there";
    run_all(plan);
    test::expect_same_pixels(plan.folder + "/merged/cornell.exr", folder / "whole.exr");
}

TEST(Plan, QuotesForShells) {
    for (const std::string text : {"plain", "it's", "a b", "$HOME `id` \"x\" \\ * ~ ; &", "''", "-n"}) {
        const Finished echoed = test::shell("printf %s " + shell_quoted(text));
        EXPECT_EQ(echoed.out, text);
    }
}

TEST(Plan, UsageErrorsExitWithTwo) {
    const TemporaryFolder folder;
    const std::string scene = scene_file("cornell"), output = folder / "plan";
    const auto refused = [&](const Arguments& arguments, int code, const std::string& words) {
        const Finished finished = blush(test::joined({"plan"}, arguments));
        EXPECT_EQ(finished.exit_code, code) << finished.err;
        EXPECT_TRUE(test::is_one_line(finished.err)) << finished.err;
        EXPECT_NE(finished.err.find(words), std::string::npos) << finished.err;
    };
    refused({}, 2, "plan needs -o DIR");
    refused({"-o", output}, 2, "needs a SCENE or --snapshots");
    refused({scene}, 2, "plan needs -o DIR");
    refused({scene, "-o", output, "--chunk", "24"}, 2, "power of two");
    refused({scene, "-o", output, "--samples", "0:4"}, 2, "--samples cannot be planned");
    refused({scene, "-o", output, "--denoise", "fast"}, 2, "--denoise cannot be planned");
    refused({scene, "-o", output, "--layers", "depths"}, 2, "unknown layer");
    refused({scene, "-o", output, "--frames", "0:3", "--turntable", "3"}, 2, "exclude each other");
    refused({scene, "-o", output, "--fps", "0"}, 2, "--fps must be");
    refused({scene, "-o", output, "--program", "a\nb"}, 2, "--program must be one line");
    refused({scene, "-o", output, "--watch"}, 2, "--watch is not for making a plan");
    refused({"run", output}, 2, "plan run needs DIR TASK");
    refused({"status"}, 2, "plan status needs DIR");
    refused({"status", output, "--spp", "4"}, 2, "blush plan status has no --spp");
    refused({"resume", output, "more"}, 2, "plan resume needs DIR");
    refused({"status", output}, 1, "there is no such folder");
    refused({"merge", folder.path().string()}, 1, "plan.json");
    refused({folder / "none.gltf", "-o", output, "--quiet"}, 1, "none.gltf");
    refused({scene, "-o", output, "--quiet", "--cameras", "7"}, 1, "there is no camera \"7\"");
    refused({scene, "-o", output, "--quiet", "--variants", "all"}, 1, "has no variant");
    refused({scene, "-o", output, "--quiet", "--frames", "0:3"}, 1, "no animation");
    refused({scene, "-o", output, "--quiet", "--looks", folder / "none.json"}, 1, "none.json");
}

TEST(Plan, StatusIsABarWithALinePerLook) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = scene_file("cornell"), .folder = folder / "plan"};
    plan.make();
    expect_done(plan.task(1));
    const std::string begun = expect_done({"plan", "status", plan.folder}).out;
    EXPECT_NE(begun.find("[#####---------------]  25 %  1 of 4 tasks, 0 running"), std::string::npos) << begun;
    EXPECT_NE(begun.find(" left for one worker"), std::string::npos) << begun;
    EXPECT_NE(begun.find("16 of 64 samples\n"), std::string::npos) << begun;
    run_all(plan);
    const std::string done = expect_done({"plan", "status", plan.folder, "--watch"}).out; // ends, since all is done
    EXPECT_NE(done.find("[####################] 100 %  4 of 4 tasks, 0 running"), std::string::npos) << done;
    EXPECT_NE(done.find("64 of 64 samples, merged to 64, error "), std::string::npos) << done;
    EXPECT_EQ(done.find(" left "), std::string::npos) << done;
}

TEST(Plan, MergeKnowsItsLooks) {
    const TemporaryFolder folder;
    const SmallPlan plan{.scene = scene_file("cornell"), .folder = folder / "plan"};
    plan.make();
    const Finished unknown = blush({"plan", "merge", plan.folder, "missing-look"}),
                   unfinished = blush({"plan", "merge", plan.folder, "--quiet"});
    EXPECT_NE(unknown.err.find("has no look \"missing-look\""), std::string::npos) << unknown.err;
    EXPECT_EQ(unfinished.exit_code, 1);
    EXPECT_NE(unfinished.err.find("1 of 1 looks lack samples"), std::string::npos) << unfinished.err;
}

} // namespace
} // namespace blush::TEST_FILE
