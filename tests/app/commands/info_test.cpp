#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace blush::TEST_FILE {
namespace {

using test::blush_json;
using test::Finished;
using test::scene_file;
using Json = nlohmann::json;

TEST(InfoCommand, JsonHasTheKeysOfTheContract) {
    const Json json = blush_json({"info", scene_file("cornell")});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(test::keys_of(json),
              (std::vector<std::string>{"animations", "cameras", "extensions", "instances", "kernel", "lights", "materials", "memory_mb",
                                        "meshes", "scenes", "seconds", "textures", "triangles", "variants", "warnings"}));
    EXPECT_EQ(test::keys_of(json["extensions"]), (std::vector<std::string>{"approximated", "honoured", "ignored", "used"}));
    EXPECT_EQ(json["cameras"], 1);
    // Five walls, two boxes of five visible sides, the light.
    EXPECT_GE(json["triangles"], 2 * (5 + 2 * 5 + 1));
    EXPECT_GE(json["lights"]["emissive_triangles"], 2);
    EXPECT_FALSE(json["kernel"]["name"].get<std::string>().empty());
    EXPECT_EQ(test::keys_of(json["kernel"]), (std::vector<std::string>{"features", "left_out", "made", "name", "pilots"}));
    EXPECT_FALSE(json["kernel"]["left_out"].empty());
    for (const Json& left_out : json["kernel"]["left_out"]) EXPECT_FALSE(left_out["why"].get<std::string>().empty()) << left_out;
    const auto is_image_library = [](const Json& use) { return use["name"] == "OpenImageIO"; };
    EXPECT_TRUE(std::ranges::any_of(json["kernel"]["left_out"], is_image_library));
    EXPECT_FALSE(std::ranges::any_of(json["kernel"]["made"], is_image_library));
}

// The feature report equals that of a render with default options.
TEST(InfoCommand, HasTheDefaultsOfRender) {
    const test::TemporaryFolder folder;
    const Json info = blush_json({"info", scene_file("furnace")})["kernel"];
    const Json render = blush_json({"render", scene_file("furnace"), "-o", folder / "furnace.exr", "--spp", "1", "--quiet"})["kernel"];
    EXPECT_EQ(info["features"], render["features"]);
    EXPECT_EQ(std::ranges::count(info["features"], Json("path reuse")), 1) << info["features"];
}

TEST(InfoCommand, ListsTheFeaturesOfAScene) {
    const Finished finished = test::blush({"info", scene_file("furnace")});
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    for (const char* word : {"geometry", "an environment", "kernel", "left out", "saves"})
        EXPECT_NE(finished.out.find(word), std::string::npos) << word;
}

TEST(InfoCommand, ComparesTheKernelWithTheFullKernel) {
    const Json speed = blush_json({"info", scene_file("cornell"), "--measure"})["kernel"]["speed"];
    ASSERT_TRUE(speed.is_object());
    EXPECT_NE(speed["own"], speed["full"]);
    for (const char* key : {"own_mpaths_per_s", "full_mpaths_per_s", "ratio"}) EXPECT_GT(speed[key].get<double>(), 0) << key;
}

} // namespace
} // namespace blush::TEST_FILE
