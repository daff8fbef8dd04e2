// Exit codes and error lines that scripts depend on.
#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <fstream>

namespace blush::TEST_FILE {
namespace {

using test::Finished;
using test::is_one_line;
using test::scene_file;
using test::TemporaryFolder;

testing::AssertionResult refused(int code, const std::vector<std::string>& arguments, const std::string& words) {
    const Finished finished = test::blush(arguments);
    if (finished.exit_code != code) return testing::AssertionFailure() << "exit code " << finished.exit_code << ": " << finished.err;
    if (!is_one_line(finished.err) || !finished.err.starts_with("blush: error: ") || finished.err.find(words) == std::string::npos)
        return testing::AssertionFailure() << "stderr: " << finished.err;
    if (!finished.out.empty()) return testing::AssertionFailure() << "stdout: " << finished.out;
    return testing::AssertionSuccess();
}

TEST(Usage, HelpAndVersionAreOnStdout) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--help"}, {"render", "--help"}, {"compare", "--help"}, {"info", "--help"}}) {
        const Finished help = test::blush(arguments);
        EXPECT_EQ(help.exit_code, 0);
        EXPECT_NE(help.out.find("--json"), std::string::npos);
        EXPECT_TRUE(help.err.empty());
    }
    const Finished version = test::blush({"--version"});
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_TRUE(version.out.starts_with("blush ") && is_one_line(version.out)) << version.out;
}

TEST(Usage, UsageErrorsExitWithTwo) {
    const std::string scene = scene_file("cornell");
    EXPECT_TRUE(refused(2, {"render"}, "scene is required"));
    EXPECT_TRUE(refused(2, {"render", scene}, "render needs -o"));
    EXPECT_TRUE(refused(2, {"render", scene, "-o", "x.exr", "--colour", "red"}, "--colour"));
    EXPECT_TRUE(refused(2, {"render", scene, "-o", "x.tga"}, "must end in .exr, .png or .jpg"));
    EXPECT_TRUE(refused(2, {"render", scene, "-o", "x.exr", "--roulette", "often"}, "unknown roulette rule"));
    EXPECT_TRUE(refused(2, {"render", scene, "-o", "x.exr", "--size", "640"}, "WIDTHxHEIGHT"));
    EXPECT_TRUE(refused(2, {"render", scene, "-o", "x.exr", "--size", "0x10"}, "width and height must be from 1 to 65536"));
    EXPECT_TRUE(refused(2, {"render", scene, "-o", "x.exr", "--spp", "many"}, "--spp"));
    EXPECT_TRUE(refused(2, {"render", scene, "-o", "x.exr", "--spp", "4", "--samples", "0:4"}, "--samples"));
    EXPECT_TRUE(refused(2, {"render", scene, "-o", "x.exr", "--samples", "4:4"}, "0 <= A < B"));
    EXPECT_TRUE(refused(2, {"render", scene, "-o", "x.exr", "--layers", "albedo,depths"}, "unknown layer \"depths\""));
    EXPECT_TRUE(refused(2, {"render", scene, "-o", "x.exr", "--groups", "by-colour"}, "by-light, by-object"));
    EXPECT_TRUE(refused(2, {"render", scene, "-o", "x.png", "--layers", "albedo"}, "--layers needs an .exr"));
    EXPECT_TRUE(refused(2, {"render", scene, "-o", "x.exr", "--denoise", "yes"}, "must be off, fast or high"));
    EXPECT_TRUE(refused(2, {"render", scene, "--pixel", "5"}, "--pixel must be X,Y"));
    EXPECT_TRUE(refused(2, {"render", scene, "--pixel", "1280,0"}, "outside of 1280x720"));
    EXPECT_TRUE(refused(2, {"compare", "a.exr"}, "b is required"));
    EXPECT_TRUE(refused(2, {"denoise", "a.exr"}, "--output is required"));
    EXPECT_TRUE(refused(2, {"denoise", "a.exr", "-o", "b.tga"}, "must end in .exr, .png or .jpg"));
    EXPECT_TRUE(refused(2, {"denoise", "a.exr", "-o", "b.exr", "--quality", "best"}, "must be fast or high"));
    EXPECT_TRUE(refused(2, {"info"}, "scene is required"));
    EXPECT_TRUE(refused(2, {"a.gltf", "b.gltf"}, "b.gltf"));
}

// The next option is not taken as the value of one that lacks its own: no file is written under its name.
TEST(Usage, OptionsAreNoValues) {
    const std::string scene = scene_file("cornell");
    const TemporaryFolder folder;
    EXPECT_TRUE(
        refused(2, {"render", scene, "-o", folder / "x.exr", "--spp", "1", "--json", "--quiet"}, "--json has no value before --quiet"));
    EXPECT_TRUE(refused(2, {"render", scene, "-o", "--quiet"}, "--output has no value before --quiet"));
    EXPECT_TRUE(refused(2, {"info", scene, "--json", "--unknown"}, "./--unknown"));
    EXPECT_TRUE(refused(2, {"--json", "--quiet"}, "--json"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_FALSE(std::filesystem::exists("--quiet") || std::filesystem::exists("--unknown"));
    EXPECT_EQ(test::blush({"info", scene, "--json", "-"}).exit_code, 0); // stdout
}

TEST(Usage, FailuresExitWithOneAndNameTheFile) {
    const TemporaryFolder folder;
    std::ofstream(folder / "broken.gltf") << "{ \"asset\": ";
    const std::string scene = scene_file("cornell"), output = folder / "x.exr";
    EXPECT_TRUE(refused(1, {"render", folder / "none.gltf", "-o", output}, "none.gltf: "));
    EXPECT_TRUE(refused(1, {"render", folder / "broken.gltf", "-o", output}, "broken.gltf: "));
    EXPECT_TRUE(refused(1, {"info", folder / "none.gltf"}, "none.gltf: "));
    EXPECT_TRUE(refused(1, {"render", scene, "-o", folder / "no/such/folder/x.exr"}, "x.exr: its folder does not exist"));
    EXPECT_TRUE(refused(1, {"render", scene, "-o", output, "--camera", "Nobody"}, "cornell.gltf: there is no camera \"Nobody\""));
    EXPECT_TRUE(refused(1, {"render", scene, "-o", output, "--env", folder / "none.exr"}, "none.exr: "));
    EXPECT_TRUE(refused(1, {"render", scene, "-o", folder / "x.png", "--view", "Nowhere"}, "Nowhere"));
    EXPECT_TRUE(refused(1, {"compare", folder / "none.exr", folder / "none.exr"}, "none.exr: "));
    // Neither output nor temporary files are left.
    for (const auto& left : std::filesystem::directory_iterator(folder.path())) EXPECT_EQ(left.path().filename(), "broken.gltf");
}

// A file name may hold anything but / and NUL; the error stays one line.
TEST(Usage, HostileNamesStayOnOneLine) { EXPECT_TRUE(refused(1, {"info", "two\nlines\033[2J.gltf"}, "two lines")); }

} // namespace
} // namespace blush::TEST_FILE
