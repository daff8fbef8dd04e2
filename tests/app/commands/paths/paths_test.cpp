// `blush paths`: all vertices as JSON, SVG and OBJ, and a sum that is what `blush render` writes for the pixel.
#include "io/image/image_io.h"
#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace blush::TEST_FILE {
namespace {

using test::blush;
using test::blush_json;
using test::Finished;
using test::is_one_line;
using test::keys_of;
using test::scene_file;
using test::TemporaryFolder;
using Json = nlohmann::json;

std::vector<std::string> paths_of(const std::string& scene, const std::string& pixel, const std::string& samples,
                                  const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"paths", scene_file(scene), "--pixel", pixel, "--samples", samples, "--size", "32x20"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::string text_of(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

int count_of(const std::string& text, const std::string& word) {
    int count = 0;
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

// The lesson's example, as a user sees it.
TEST(Paths, PrintsTheLessonsArithmetic) {
    const Finished finished = blush(paths_of("two-bounces", "14,14", "0:400", {"--strategy", "bsdf"}));
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_NE(finished.out.find("... 384 more samples"), std::string::npos);
    const Json json = blush_json(paths_of("two-bounces", "14,14", "0:400", {"--strategy", "bsdf"}));
    int found = 0;
    for (const Json& path : json["paths"]) {
        const Json& v = path["vertices"];
        if (v.size() != 3 || v[1]["object"] != "white floor" || v[2]["object"] != "lamp") continue;
        ++found;
        EXPECT_EQ(path["arithmetic"]["red"][0]["text"], "0.7 x 0.9 x 12 = 7.56");
        EXPECT_EQ(path["arithmetic"]["red"][0]["strategy"], "camera_hit");
        EXPECT_FLOAT_EQ(path["radiance"][0].get<float>(), 7.56f);
        EXPECT_EQ(v[0]["scatters"], "diffuse");
        EXPECT_EQ(v[0]["material"], "red");
        EXPECT_FLOAT_EQ(v[0]["factor"][0].get<float>(), 0.7f);
        EXPECT_FLOAT_EQ(v[1]["beta"][0].get<float>(), 0.63f);
        EXPECT_EQ(v[2]["end"], "light");
    }
    EXPECT_GT(found, 10);
}

// Adaptive sampling is off; path reuse and smooth edges are in the image, but not in the sum.
TEST(Paths, SumsToWhatRenderWrites) {
    const TemporaryFolder folder;
    const Json json = blush_json(paths_of("cornell", "16,12", "3:35", {"--reuse", "16"}));
    ASSERT_TRUE(json.is_object());
    EXPECT_LT(json["film"]["difference"].get<double>(), 1e-6);
    EXPECT_EQ(json["film"]["left_out"].size(), 2u);
    EXPECT_NE(json["film"]["image"], json["film"]["mean"]);
    for (const auto& [more, mean] : {std::pair{std::vector<std::string>{"--reuse", "off", "--smooth-edges", "off"}, json["sum"]["mean"]},
                                     {std::vector<std::string>{"--reuse", "16"}, json["film"]["image"]}}) {
        std::vector<std::string> arguments{"render", scene_file("cornell"), "-o", folder / "a.exr", "--samples", "3:35", "--size", "32x20",
                                           "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        ASSERT_EQ(blush(arguments).exit_code, 0);
        const Result<LayeredImage> image = read_layers(folder / "a.exr");
        ASSERT_TRUE(image);
        const char* const channels[] = {"R", "G", "B"};
        for (int k = 0; k < 3; ++k) {
            const double value = image->find(channels[k])->values[12 * 32 + 16], sum = mean[size_t(k)].get<double>();
            EXPECT_NEAR(value, sum, 2e-6 * sum);
        }
    }
}

TEST(Paths, HasTheKeysOfItsReference) {
    const Json json = blush_json(paths_of("wine-glass", "16,10", "0:64", {"--caustics", "off"}));
    EXPECT_EQ(keys_of(json), (std::vector<std::string>{"film", "height", "paths", "pixel", "samples", "scene", "seed", "sum", "width"}));
    EXPECT_EQ(keys_of(json["film"]), (std::vector<std::string>{"difference", "image", "left_out", "mean"}));
    EXPECT_EQ(keys_of(json["sum"]), (std::vector<std::string>{"invalid", "lengths", "mean", "paths", "strategies"}));
    EXPECT_EQ(json["sum"]["lengths"].size(), 8u);
    bool emission = false, next_event = false, roulette = false, delta = false;
    for (const Json& path : json["paths"]) {
        EXPECT_EQ(keys_of(path),
                  (std::vector<std::string>{"arithmetic", "eye", "light_paths", "radiance", "sample", "shortened", "valid", "vertices"}));
        for (const Json& v : path["vertices"]) {
            EXPECT_EQ(keys_of(v), (std::vector<std::string>{
                                      "arriving", "beta",       "bounce",   "color",    "delta",          "direction", "distance",
                                      "emission", "end",        "factor",   "guided",   "light_vertices", "manifold",  "material",
                                      "met",      "next_event", "normal",   "object",   "panes",          "passed",    "past_blended",
                                      "pdf",      "position",   "roulette", "scatters", "shading_normal"}));
            emission |= v["emission"].is_object();
            roulette |= v["roulette"].is_object();
            delta |= v["delta"] == true && v["pdf"].is_null();
            if (!v["next_event"].is_object()) continue;
            next_event = true;
            EXPECT_EQ(keys_of(v["next_event"]),
                      (std::vector<std::string>{"blocked", "blocker", "bsdf_pdf", "contribution", "f_cos", "from", "infinite", "light",
                                                "light_pdf", "mis_weight", "radiance", "to", "unblocked"}));
        }
    }
    EXPECT_TRUE(emission && next_event && roulette && delta);
}

TEST(Paths, WritesLinesForOtherPrograms) {
    const TemporaryFolder folder;
    const Json json = blush_json(paths_of("cornell", "10,14", "0:12", {"--obj", folder / "a.obj", "--svg", folder / "a.svg"}));
    const std::string obj = text_of(folder / "a.obj"), svg = text_of(folder / "a.svg");
    size_t vertices = 0, connections = 0, blocked = 0;
    for (const Json& path : json["paths"]) {
        vertices += path["vertices"].size() + 1; // and the eye
        for (const Json& v : path["vertices"]) {
            connections += v["next_event"].is_object();
            blocked += v["next_event"].is_object() && v["next_event"]["blocked"] == true;
        }
    }
    EXPECT_EQ(count_of(obj, "\nv "), int(vertices + 2 * connections));
    EXPECT_EQ(count_of(obj, "\nl "), int(12 + connections));
    EXPECT_EQ(count_of(obj, "_blocked\n"), int(blocked));
    EXPECT_TRUE(svg.starts_with("<svg xmlns=") && svg.ends_with("</svg>\n"));
    EXPECT_EQ(count_of(svg, "<g id='sample-"), 12);
    EXPECT_EQ(count_of(svg, "stroke-dasharray"), int(connections));
    EXPECT_NE(svg.find("data:image/png;base64,iVBOR"), std::string::npos);
    EXPECT_EQ(svg.find("http://", svg.find("xlink'")), std::string::npos); // nothing from elsewhere
}

// A sample that stops early is an error of one line, with exit code 1 or 2.
TEST(Paths, RefusesWhatItCannotReplay) {
    const auto refused = [](const std::vector<std::string>& arguments, int code, const std::string& words) {
        const Finished finished = blush(arguments);
        EXPECT_EQ(finished.exit_code, code) << finished.err;
        EXPECT_TRUE(is_one_line(finished.err) && finished.err.find(words) != std::string::npos) << finished.err;
        EXPECT_TRUE(finished.out.empty());
    };
    refused({"paths", scene_file("cornell")}, 2, "--pixel is required");
    refused(paths_of("cornell", "32,0", "0:4"), 2, "--pixel 32,0 is outside of 32x20");
    refused(paths_of("cornell", "3", "0:4"), 2, "--pixel must be X,Y");
    refused(paths_of("cornell", "3,3", "4:4"), 2, "0 <= A < B");
    refused(paths_of("cornell", "3,3", "0:200000"), 2, "at most 100000 samples");
    refused(paths_of("cornell", "3,3", "0:4", {"--time", "3"}), 2, "no --time or --error");
    refused(paths_of("cornell", "3,3", "0:4", {"--region", "0,0,4,4"}), 2, "no --region");
    refused(paths_of("cornell", "3,3", "0:4", {"--denoise", "fast"}), 2, "no image to denoise");
    refused(paths_of("cornell", "3,3", "0:4", {"--adaptive", "on"}), 2, "adaptive sampling chooses its own");
    refused(paths_of("cornell", "3,3", "0:4", {"--obj", "/nowhere/a.obj"}), 1, "/nowhere/a.obj: its folder does not exist");
    refused({"paths", "/nowhere.gltf", "--pixel", "1,1", "--quiet"}, 1, "/nowhere.gltf");
}

} // namespace
} // namespace blush::TEST_FILE
