// `blush render` as a script calls it.
#include "io/image/image_io.h"
#include "io/image/snapshot.h"
#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <numeric>

namespace blush::TEST_FILE {
namespace {

using test::blush_json;
using test::Finished;
using test::scene_file;
using test::TemporaryFolder;
using Json = nlohmann::json;

std::vector<std::string> tiny(const std::string& scene, const std::string& output) {
    return {"render", scene_file(scene), "-o", output, "--size", "24x16", "--spp", "4"};
}

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::vector<float> beauty(const LayeredImage& image) {
    std::vector<float> values;
    for (const char* name : {"R", "G", "B"})
        if (const auto* channel = image.find(name)) values.insert(values.end(), channel->values.begin(), channel->values.end());
    return values;
}

TEST(Render, SaysThatAnIntegratorIsBiased) {
    const TemporaryFolder folder;
    const std::vector<std::string> ambient = with(tiny("cornell", folder / "out.exr"), {"--integrator", "ambient,distance=0.5"});
    const Finished finished = test::blush(ambient);
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_NE(finished.out.find("ambient,color=auto,distance=0.5: biased"), std::string::npos) << finished.out;
    const Result<LayeredImage> image = read_layers(folder / "out.exr");
    ASSERT_TRUE(image) << image.error().text();
    const Result<SnapshotMetadata> metadata = read_snapshot_metadata(image->metadata);
    ASSERT_TRUE(metadata) << metadata.error().text();
    EXPECT_TRUE(metadata->biased.starts_with("ambient,color=auto,distance=0.5: biased")) << metadata->biased;
    EXPECT_TRUE(blush_json(ambient)["biased"].get<std::string>().starts_with("ambient"));
    EXPECT_FALSE(blush_json(tiny("cornell", folder / "path.exr")).contains("biased"));
    for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
             {"--layers", "film"}, {"--layers", "bounces"}, {"--clamp", "10"}, {"--samples", "0:2"}, {"--pixel", "1,1"}})
        EXPECT_EQ(test::blush(with({"render", scene_file("cornell"), "-o", folder / "no.exr", "--integrator", "ambient"}, more)).exit_code,
                  2)
            << more[0];
    EXPECT_EQ(test::blush(with(tiny("cornell", folder / "no.exr"), {"--integrator", "photons"})).exit_code, 2);
}

TEST(Render, WritesAnExrWithItsMetadata) {
    const TemporaryFolder folder;
    const Finished finished = test::blush(with(tiny("cornell", folder / "out.exr"), {"--seed", "5"}));
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_NE(finished.out.find("24x16, 4 spp"), std::string::npos) << finished.out;
    const Result<LayeredImage> image = read_layers(folder / "out.exr");
    ASSERT_TRUE(image) << image.error().text();
    EXPECT_EQ(image->width, 24);
    EXPECT_EQ(image->height, 16);
    std::vector<std::string> names;
    for (const auto& channel : image->channels) names.push_back(channel.name);
    std::ranges::sort(names);
    EXPECT_EQ(names, (std::vector<std::string>{"A", "B", "G", "R"}));
    const Result<SnapshotMetadata> metadata = read_snapshot_metadata(image->metadata);
    ASSERT_TRUE(metadata) << metadata.error().text();
    EXPECT_EQ(metadata->scene, "cornell.gltf");
    EXPECT_EQ(metadata->spp, 4);
    EXPECT_EQ(metadata->seed, 5u);
    EXPECT_EQ(metadata->settings.seed, 5u);
    EXPECT_FALSE(metadata->partial);
    EXPECT_FALSE(metadata->scene_hash.empty());
    // Only the image remains.
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Render, WritesTheLayersAskedFor) {
    const TemporaryFolder folder;
    const Finished finished = test::blush(with(tiny("cornell", folder / "out.exr"), {"--layers", "albedo,normal,depth,error,samples,id"}));
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const LayeredImage image = *read_layers(folder / "out.exr");
    for (const char* name : {"albedo.R", "normal.X", "normal.Z", "depth.Z", "error.G", "samples.Y", "id.object", "id.material"})
        EXPECT_NE(image.find(name), nullptr) << name;
    EXPECT_EQ(image.find("samples.Y")->values[0], 4);
    // The centre of the image shows an object inside the box, which has an id.
    const size_t middle = 24 * 8 + 12;
    EXPECT_GT(image.find("depth.Z")->values[middle], 0);
    EXPECT_GE(image.find("id.object")->values[middle], 1);
    EXPECT_GE(image.find("id.material")->values[middle], 1);
}

TEST(Render, BouncesSumToTheBeautyInFileAndJson) {
    const TemporaryFolder folder;
    const Json json = blush_json(with(tiny("cornell", folder / "out.exr"), {"--layers", "bounces=3", "--quiet"}));
    ASSERT_EQ(json["bounces"].size(), 3u);
    EXPECT_EQ(json["bounces"][0]["bounce"], "0");
    EXPECT_EQ(json["bounces"][2]["bounce"], "2+");
    double share = 0;
    for (const Json& bounce : json["bounces"]) {
        EXPECT_GT(bounce["share"], 0);
        share += double(bounce["share"]);
    }
    EXPECT_NEAR(share, 1, 1e-12);
    const LayeredImage image = *read_layers(folder / "out.exr");
    EXPECT_EQ(image.find("bounce.3.R"), nullptr);
    for (const std::string channel : {"R", "G", "B"}) {
        for (size_t i = 0; i < 24 * 16; ++i) {
            double sum = 0;
            for (const char* bounce : {"bounce.0.", "bounce.1.", "bounce.2."}) sum += double(image.find(bounce + channel)->values[i]);
            const double whole = double(image.find(channel)->values[i]);
            EXPECT_NEAR(sum, whole, whole * 0x1.01p-23) << channel << i;
        }
    }
}

TEST(Render, GroupsSumToTheBeautyInFileAndJson) {
    const TemporaryFolder folder;
    const Json json =
        blush_json(with(tiny("card-and-mug", folder / "out.exr"), {"--layers", "groups", "--groups", "by-object", "--quiet"}));
    double energy = 0;
    for (const Json& group : json["groups"]) energy += double(group["energy"]);
    EXPECT_NEAR(energy, 1, 1e-9);
    const LayeredImage image = *read_layers(folder / "out.exr");
    for (const std::string channel : {"R", "G", "B"}) {
        for (size_t i = 0; i < 24 * 16; ++i) {
            double sum = 0;
            for (const Json& group : json["groups"])
                sum += double(image.find("group." + std::string(group["group"]) + "." + channel)->values[i]);
            const double whole = double(image.find(channel)->values[i]);
            EXPECT_NEAR(sum, whole, whole * 0x1p-18) << channel << i; // reused paths are summed in single precision
        }
    }
    EXPECT_EQ(blush_json(with(tiny("cornell", folder / "one.exr"), {"--layers", "groups", "--quiet"}))["groups"].size(), 1u) << "by light";
}

TEST(Render, AdaptiveSamplingIsRecordedAndItsLayerHoldsTheSamplesOfEachPixel) {
    const TemporaryFolder folder;
    const std::vector<std::string> arguments = {"render", scene_file("cornell"), "-o", folder / "out.exr", "--size", "64x48", "--spp",
                                                "40",     "--adaptive",          "on", "--layers",         "samples"};
    const Json json = blush_json(arguments);
    const LayeredImage image = *read_layers(folder / "out.exr");
    const std::vector<float>& samples = image.find("samples.Y")->values;
    EXPECT_NE(*std::ranges::min_element(samples), *std::ranges::max_element(samples));
    EXPECT_EQ(std::accumulate(samples.begin(), samples.end(), 0.0), json["rays"]["camera"].get<double>());
    const Result<SnapshotMetadata> metadata = read_snapshot_metadata(image.metadata);
    ASSERT_TRUE(metadata) << metadata.error().text();
    EXPECT_TRUE(metadata->settings.adaptive);
    EXPECT_EQ(metadata->spp, 40);
}

TEST(Render, ClampingReportsLostEnergy) {
    const TemporaryFolder folder;
    const Json plain = blush_json(with(tiny("cornell", folder / "plain.exr"), {"--quiet"}));
    EXPECT_FALSE(plain.contains("clamp")) << "off by default";
    const Finished finished = test::blush(with(tiny("cornell", folder / "out.exr"), {"--clamp", "0.2,all", "--json", folder / "out.json"}));
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_NE(finished.out.find("clamping removed "), std::string::npos) << finished.out;
    std::ifstream file(folder / "out.json");
    const Json json = Json::parse(file, nullptr, false);
    EXPECT_EQ(json["clamp"]["light"], "all");
    EXPECT_GT(json["clamp"]["samples"], 0);
    EXPECT_GT(json["clamp"]["share"], 0);
    for (const float value : beauty(*read_layers(folder / "out.exr"))) EXPECT_LE(value, 0.2f);
}

TEST(Render, WritesImagesForDisplay) {
    const TemporaryFolder folder;
    for (const char* name : {"out.png", "out.jpg"}) {
        const Finished finished = test::blush(tiny("cornell", folder / name));
        ASSERT_EQ(finished.exit_code, 0) << finished.err;
        const Result<ImagePtr> image = read_image(folder / name);
        ASSERT_TRUE(image) << image.error().text();
        EXPECT_EQ((*image)->width, 24);
        EXPECT_EQ((*image)->channels, 3);
        EXPECT_FALSE((*image)->bytes.empty());
    }
}

TEST(Render, ExposureBrightensImagesAndLeavesExrsAlone) {
    const TemporaryFolder folder;
    const auto sum = [&](const std::string& file) {
        int64_t total = 0;
        const auto image = read_image(folder / file);
        for (const uint8_t byte : (*image)->bytes) total += byte;
        return total;
    };
    ASSERT_EQ(test::blush(tiny("cornell", folder / "plain.png")).exit_code, 0);
    ASSERT_EQ(test::blush(with(tiny("cornell", folder / "bright.png"), {"--exposure", "2"})).exit_code, 0);
    EXPECT_GT(sum("bright.png"), sum("plain.png"));
    ASSERT_EQ(test::blush(tiny("cornell", folder / "plain.exr")).exit_code, 0);
    ASSERT_EQ(test::blush(with(tiny("cornell", folder / "bright.exr"), {"--exposure", "2"})).exit_code, 0);
    EXPECT_EQ(beauty(*read_layers(folder / "plain.exr")), beauty(*read_layers(folder / "bright.exr")));
}

TEST(Render, ImageDoesNotDependOnThreads) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::blush(with(tiny("cornell", folder / "one.exr"), {"--threads", "1"})).exit_code, 0);
    ASSERT_EQ(test::blush(with(tiny("cornell", folder / "three.exr"), {"--threads", "3"})).exit_code, 0);
    ASSERT_EQ(test::blush(with(tiny("cornell", folder / "seed.exr"), {"--seed", "1"})).exit_code, 0);
    const std::vector<float> one = beauty(*read_layers(folder / "one.exr"));
    EXPECT_EQ(one, beauty(*read_layers(folder / "three.exr")));
    EXPECT_NE(one, beauty(*read_layers(folder / "seed.exr")));
}

TEST(Render, SampleRangesAverageToTheWhole) {
    const TemporaryFolder folder;
    const auto render = [&](const std::string& name, const std::string& samples) {
        const Finished finished =
            test::blush({"render", scene_file("cornell"), "-o", folder / name, "--size", "24x16", "--samples", samples});
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return *read_layers(folder / name);
    };
    const LayeredImage first = render("a.exr", "0:4"), second = render("b.exr", "4:8"), whole = render("c.exr", "0:8");
    const std::vector<float> a = beauty(first), b = beauty(second), both = beauty(whole);
    for (size_t i = 0; i < both.size(); ++i) EXPECT_NEAR(0.5 * (a[i] + b[i]), both[i], 1e-5 * (1 + both[i]));
    const SnapshotMetadata metadata = *read_snapshot_metadata(second.metadata);
    EXPECT_EQ(metadata.spp, 4);
    EXPECT_EQ(metadata.first_sample, 4);
    EXPECT_EQ(metadata.last_sample, 8);
}

// The camera of the Cornell box is square.
TEST(Render, TheHeightFollowsTheCamera) {
    const TemporaryFolder folder;
    const auto size_of = [&](const std::vector<std::string>& size, std::string& err) {
        const Finished finished = test::blush(with({"render", scene_file("cornell"), "-o", folder / "out.exr", "--spp", "1"}, size));
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        err = finished.err;
        const Result<LayeredImage> image = read_layers(folder / "out.exr");
        return image ? std::pair(image->width, image->height) : std::pair(0, 0);
    };
    std::string err;
    EXPECT_EQ(size_of({"--size", "48x"}, err), std::pair(48, 48));
    EXPECT_EQ(err.find("note"), std::string::npos);
    EXPECT_EQ(size_of({"--size", "x32"}, err), std::pair(32, 32));
    EXPECT_EQ(size_of({"--size", "48x24"}, err), std::pair(48, 24));
    EXPECT_NE(err.find("48x24 is 2:1, the camera's frame is 1:1"), std::string::npos) << err;
    EXPECT_EQ(size_of({"--size", "48x24", "--quiet"}, err), std::pair(48, 24));
    EXPECT_EQ(err, "");
}

// A shadow catcher: the image is for compositing over another.
TEST(Render, ShadowCatchersGivePngsAnAlpha) {
    const TemporaryFolder folder;
    const std::string scene = folder / "caught.gltf";
    std::ifstream in(scene_file("card-and-mug"));
    nlohmann::json json = nlohmann::json::parse(in);
    for (nlohmann::json& node : json["nodes"])
        if (node.contains("mesh")) {
            node["extras"]["blush"]["fields"]["shadow_catcher"] = true;
            break;
        }
    json["scenes"][0].erase("extras");
    std::ofstream(scene) << json;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(scene_file("cornell")).parent_path()))
        if (entry.path().filename().string().starts_with("card-and-mug.") && entry.path().extension() != ".gltf")
            std::filesystem::copy_file(entry.path(), std::filesystem::path(folder / entry.path().filename().string()));
    for (const char* name : {"out.png", "out.exr"}) {
        const Finished finished = test::blush({"render", scene, "-o", folder / name, "--size", "48x32", "--spp", "4"});
        ASSERT_EQ(finished.exit_code, 0) << finished.err;
    }
    const Result<ImagePtr> png = read_image(folder / "out.png");
    ASSERT_TRUE(png);
    ASSERT_EQ((*png)->channels, 4);
    const Result<LayeredImage> exr = read_layers(folder / "out.exr");
    ASSERT_TRUE(exr);
    const auto* alpha = exr->find("A");
    ASSERT_TRUE(alpha);
    int opaque = 0, shadow = 0, clear = 0;
    for (size_t i = 0; i < alpha->values.size(); ++i) {
        EXPECT_NEAR(alpha->values[i] * 255, float((*png)->bytes[4 * i + 3]), 0.6f);
        opaque += alpha->values[i] == 1;
        clear += alpha->values[i] == 0;
        shadow += alpha->values[i] > 0 && alpha->values[i] < 1;
    }
    EXPECT_GT(opaque, 20);
    EXPECT_GT(shadow + clear, 20);
    EXPECT_GT(shadow, 0);
}

TEST(Render, TheEnvironmentCanBeReplaced) {
    const TemporaryFolder folder;
    // Only the environment emits in the furnace: without it the image is black, with another it has another colour.
    ASSERT_EQ(test::blush(with(tiny("furnace", folder / "black.exr"), {"--env", "none"})).exit_code, 0);
    for (const float v : beauty(*read_layers(folder / "black.exr"))) EXPECT_EQ(v, 0);
    ASSERT_EQ(test::blush(with(tiny("furnace", folder / "blue.exr"), {"--env", "constant=0,0,3"})).exit_code, 0);
    const LayeredImage blue = *read_layers(folder / "blue.exr");
    EXPECT_EQ(blue.find("R")->values[0], 0);
    EXPECT_NEAR(blue.find("B")->values[0], 3, 1e-4);
    EXPECT_NE(read_snapshot_metadata(blue.metadata)->edits.find("environment"), std::string::npos);
}

TEST(Render, PeakMemoryIsThatOfTheProgramAlone) {
    const TemporaryFolder folder;
    const double alone = blush_json(with(tiny("cornell", folder / "out.exr"), {"--quiet"}))["peak_memory_mb"];
    const std::vector<char> held(size_t(alone + 200) << 20, 1); // by the process that starts it
    const Json json = blush_json(with(tiny("cornell", folder / "again.exr"), {"--quiet"}));
    EXPECT_LT(json["peak_memory_mb"], alone + 100);
    EXPECT_EQ(held.back(), 1);
}

TEST(Render, JsonHasTheKeysOfTheContract) {
    const TemporaryFolder folder;
    const Json json = blush_json(with(tiny("cornell", folder / "out.exr"), {"--quiet"}));
    ASSERT_TRUE(json.is_object());
    for (const char* key : {"scene", "width", "height", "spp", "seconds", "seconds_setup", "rays", "mrays_per_s", "mpaths_per_s",
                            "path_length_mean", "error", "health", "warnings", "kernel", "peak_memory_mb", "output", "partial"})
        EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(test::keys_of(json["rays"]), (std::vector<std::string>{"bounce", "camera", "shadow"}));
    EXPECT_EQ(test::keys_of(json["error"]),
              (std::vector<std::string>{"high", "low", "misses_highlights", "missing_light", "relmse", "rmse", "rmse_high", "rmse_low"}));
    EXPECT_EQ(test::keys_of(json["health"]),
              (std::vector<std::string>{"faults", "fireflies", "first", "inf", "nan", "negative", "truncated"}));
    EXPECT_EQ(test::keys_of(json["kernel"]), (std::vector<std::string>{"features", "left_out", "made", "name", "pilots"}));
    EXPECT_EQ(json["width"], 24);
    EXPECT_EQ(json["spp"], 4);
    EXPECT_EQ(json["rays"]["camera"], 24 * 16 * 4);
    EXPECT_EQ(test::keys_of(json["stages"]), (std::vector<std::string>{"film", "generate", "light", "reuse", "shade", "shadow", "trace"}));
    EXPECT_EQ(json["partial"], false);
    EXPECT_EQ(json["output"], folder / "out.exr");
    EXPECT_GE(json["path_length_mean"], 1.0);
    EXPECT_GT(json["peak_memory_mb"], 0);
    EXPECT_LE(json["error"]["low"], json["error"]["relmse"]);
    EXPECT_GE(json["error"]["high"], json["error"]["relmse"]);
    EXPECT_EQ(json["health"]["nan"], 0);
}

TEST(Render, JsonCanGoToAFile) {
    const TemporaryFolder folder;
    const Finished finished = test::blush(with(tiny("cornell", folder / "out.exr"), {"--json", folder / "out.json", "--quiet"}));
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(finished.out, "");
    EXPECT_EQ(finished.err, "");
    std::ifstream file(folder / "out.json");
    EXPECT_EQ(Json::parse(file, nullptr, false)["spp"], 4);
}

TEST(Render, PixelPrintsEveryVertex) {
    const Finished finished = test::blush({"render", scene_file("cornell"), "--size", "24x16", "--pixel", "12,8,3"});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_GT(std::ranges::count(finished.out, '\n'), 2) << finished.out;
    EXPECT_EQ(finished.out, test::blush({"render", scene_file("cornell"), "--size", "24x16", "--pixel", "12,8,3"}).out);
}

// Ctrl-C after the progress bar (or the progress line without a terminal) shows samples: the image is written and marked as
// partial.
TEST(Render, CtrlCSavesThePartialImage) {
    const TemporaryFolder folder;
    bool sent = false;
    test::RunOptions options;
    options.stderr_is_terminal = test::terminals_exist();
    options.on_stderr = [&](const std::string& err, int pid) {
        if (sent || err.find(" spp") == std::string::npos) return;
        sent = kill(pid, SIGINT) == 0;
    };
    const Finished finished = test::blush({"render", scene_file("cornell"), "-o", folder / "out.exr", "--size", "64x64", "--spp",
                                           "100000000", "--time", "20", "--json", folder / "out.json"},
                                          options);
    ASSERT_TRUE(sent) << finished.err;
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_TRUE(!options.stderr_is_terminal || finished.err.find("[-") != std::string::npos) << "the bar: " << finished.err;
    EXPECT_NE(finished.out.find("partial"), std::string::npos) << finished.out;
    const Result<LayeredImage> image = read_layers(folder / "out.exr");
    ASSERT_TRUE(image) << image.error().text();
    const SnapshotMetadata metadata = *read_snapshot_metadata(image->metadata);
    EXPECT_TRUE(metadata.partial);
    EXPECT_GE(metadata.spp, 1);
    std::ifstream file(folder / "out.json");
    const Json json = Json::parse(file, nullptr, false);
    EXPECT_EQ(json["partial"], true);
    EXPECT_EQ(json["spp"], metadata.spp);
}

TEST(Render, EveryShippedSceneRenders) {
    const TemporaryFolder folder;
    for (const char* scene : {"bulb", "card-and-mug", "cornell", "corridor", "furnace", "metal-ring", "pool", "prism", "two-bounces",
                              "veach-mis", "wine-glass"}) {
        const Json json = blush_json(with(tiny(scene, folder / "out.exr"), {"--quiet"}));
        ASSERT_TRUE(json.is_object()) << scene;
        EXPECT_EQ(json["health"]["nan"], 0) << scene;
        EXPECT_EQ(json["health"]["inf"], 0) << scene;
        EXPECT_EQ(json["health"]["negative"], 0) << scene;
    }
}

// The dynamic linker lists every library that it loads. OpenImageIO brings some 240, which take longer to load than the rest to start.
TEST(RenderCommand, LoadsOpenImageIoOnlyForWhatNeedsIt) {
    const test::TemporaryFolder folder;
    const auto loads = [](const std::vector<std::string>& arguments) {
        std::vector<std::string> command{"/usr/bin/env", "LD_DEBUG=files", BLUSH_BINARY};
        command.insert(command.end(), arguments.begin(), arguments.end());
        const Finished finished = test::run(command);
        EXPECT_EQ(finished.exit_code, 0);
        EXPECT_NE(finished.err.find("libembree3"), std::string::npos) << "the linker lists nothing";
        return finished.err.find("libOpenImageIO") != std::string::npos;
    };
    const auto render = [&](const char* file) {
        return loads({"render", scene_file("furnace"), "-o", folder / file, "--size", "8x8", "--spp", "1", "--quiet"});
    };
    EXPECT_FALSE(loads({"info", scene_file("furnace")}));
    EXPECT_FALSE(render("a.jpg")) << "libjpeg encodes";
    EXPECT_TRUE(render("a.png"));
    EXPECT_TRUE(render("a.exr"));
}

} // namespace
} // namespace blush::TEST_FILE
