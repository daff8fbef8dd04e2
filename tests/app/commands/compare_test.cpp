#include "io/image/image_io.h"
#include "tests/app/program.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

using test::blush_json;
using test::Finished;
using test::TemporaryFolder;
using Json = nlohmann::json;

void write_constant_exr(const std::string& file, int width, int height, const Vec3& color) {
    LayeredImage image{.width = width, .height = height, .channels = {}, .metadata = {}};
    const size_t n = size_t(width) * size_t(height);
    image.channels = {{"R", std::vector<float>(n, color.x)}, {"G", std::vector<float>(n, color.y)}, {"B", std::vector<float>(n, color.z)}};
    const Result<void> written = write_exr(file, image);
    ASSERT_TRUE(written) << written.error().text();
}

TEST(CompareCommand, AnImageEqualsItself) {
    const TemporaryFolder folder;
    write_constant_exr(folder / "a.exr", 16, 8, {0.2f, 0.5f, 3});
    const Json json = blush_json({"compare", folder / "a.exr", folder / "a.exr"});
    EXPECT_EQ(test::keys_of(json), (std::vector<std::string>{"flip", "flip_above_0.1_percent", "flip_max", "flip_median", "flip_quartile_1",
                                                             "flip_quartile_3", "mae", "max_abs", "mean_a", "mean_b", "mse", "nonfinite_a",
                                                             "nonfinite_b", "psnr", "relmse", "rmse"}));
    for (const char* key : {"mse", "rmse", "relmse", "mae", "flip", "flip_median", "flip_max", "flip_above_0.1_percent", "max_abs"})
        EXPECT_EQ(json[key], 0.0) << key;
    EXPECT_TRUE(json["psnr"].is_null()) << "infinite";
    EXPECT_NEAR(json["mean_a"][2].get<double>(), 3, 1e-6);
}

TEST(CompareCommand, TableAgreesWithJson) {
    const TemporaryFolder folder;
    write_constant_exr(folder / "a.exr", 16, 8, {1, 1, 1});
    write_constant_exr(folder / "b.exr", 16, 8, {0.5f, 0.5f, 0.5f});
    const Finished finished = test::blush({"compare", folder / "a.exr", folder / "b.exr"});
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_NE(finished.out.find("mse          0.25\n"), std::string::npos) << finished.out;
    const Json json = blush_json({"compare", folder / "a.exr", folder / "b.exr"});
    EXPECT_EQ(json["mse"], 0.25);
    EXPECT_NEAR(json["relmse"].get<double>(), 0.25 / 0.26, 1e-12);
    EXPECT_GT(json["flip"], 0);
    EXPECT_NEAR(json["flip_median"].get<double>(), json["flip"].get<double>(), 1e-6) << "it is the same everywhere";
    EXPECT_EQ(json["flip_above_0.1_percent"], 100.0);
    EXPECT_EQ(test::blush({"compare", folder / "a.exr", folder / "b.exr", "--quiet"}).out, "");
}

TEST(CompareCommand, DisplayImages) {
    const TemporaryFolder folder;
    const std::vector<float> grey(16 * 8 * 3, 0.5f), white(16 * 8 * 3, 1.f);
    ASSERT_TRUE(write_display_image(folder / "grey.png", 16, 8, grey));
    ASSERT_TRUE(write_display_image(folder / "white.png", 16, 8, white));
    const Json json = blush_json({"compare", folder / "grey.png", folder / "white.png"});
    EXPECT_NEAR(json["mae"].get<double>(), 0.5, 1.0 / 255);
    EXPECT_NEAR(json["mean_b"][0].get<double>(), 1, 1e-6);
}

TEST(CompareCommand, IncomparableImagesAreErrors) {
    const TemporaryFolder folder;
    write_constant_exr(folder / "a.exr", 16, 8, {1, 1, 1});
    write_constant_exr(folder / "b.exr", 8, 16, {1, 1, 1});
    ASSERT_TRUE(write_display_image(folder / "c.png", 16, 8, std::vector<float>(16 * 8 * 3, 0.5f)));
    const Finished sizes = test::blush({"compare", folder / "a.exr", folder / "b.exr"});
    EXPECT_EQ(sizes.exit_code, 1);
    EXPECT_EQ(sizes.err, "blush: error: " + (folder / "a.exr") + ": the images differ in size: 16x8 and 8x16\n");
    const Finished kinds = test::blush({"compare", folder / "a.exr", folder / "c.png"});
    EXPECT_EQ(kinds.exit_code, 1);
    EXPECT_NE(kinds.err.find("scene-linear"), std::string::npos) << kinds.err;
}

} // namespace
} // namespace blush::TEST_FILE
