#include "io/image/environment_image.h"
#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace blush::test::TEST_FILE {
namespace {

TEST(EnvironmentImage, EightBitFilesBecomeLinear) {
    const TempFolder folder;
    const std::vector<float> rgb = {0, 1, 188 / 255.0f};
    ASSERT_TRUE(write_display_image(folder / "a.png", 1, 1, rgb));
    const auto image = read_environment_image(folder / "a.png");
    ASSERT_TRUE(image) << error_text(image);
    EXPECT_EQ((*image)->floats[0], 0);
    EXPECT_EQ((*image)->floats[1], 1);
    EXPECT_NEAR((*image)->floats[2], std::pow((188 / 255.0 + 0.055) / 1.055, 2.4), 1e-6);
}

// Invalid radiance is kept, so that the renderer, which reads it as black, can report its amount.
TEST(EnvironmentImage, GreyBecomesRgbAndInvalidValuesAreKept) {
    const TempFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    ASSERT_TRUE(write_exr(folder / "a.exr", LayeredImage{3, 1, {{"Y", {0.5f, nan, -1}}}, {}}));
    const auto image = read_environment_image(folder / "a.exr");
    ASSERT_TRUE(image) << error_text(image);
    EXPECT_EQ((*image)->channels, 3);
    const std::vector<float>& floats = (*image)->floats;
    ASSERT_EQ(floats.size(), 9u);
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(floats[size_t(c)], 0.5f);
        EXPECT_TRUE(std::isnan(floats[size_t(3 + c)]));
        EXPECT_EQ(floats[size_t(6 + c)], -1);
    }
}

TEST(EnvironmentImage, IsReadOnceWhileItIsInUse) {
    const TempFolder folder;
    const std::vector<float> dark(3, 0.f), bright(3, 1.f);
    ASSERT_TRUE(write_display_image(folder / "a.png", 1, 1, dark));
    Result<ImagePtr> first = read_environment_image(folder / "a.png");
    ASSERT_TRUE(first);
    EXPECT_EQ(*read_environment_image(folder / "a.png"), *first);
    ASSERT_TRUE(write_display_image(folder / "a.png", 1, 1, bright, {{"longer", "file"}}));
    const auto changed = read_environment_image(folder / "a.png");
    ASSERT_TRUE(changed);
    EXPECT_EQ((*changed)->floats[0], 1) << "the file is another one";
    const uint64_t serial = (*changed)->serial;
    first = Error{};
    EXPECT_EQ((*read_environment_image(folder / "a.png"))->serial, serial);
    std::filesystem::remove(folder / "a.png");
    EXPECT_FALSE(read_environment_image(folder / "a.png"));
}

TEST(EnvironmentImage, MissingFilesAreErrors) { EXPECT_FALSE(read_environment_image("none.exr")); }

} // namespace
} // namespace blush::test::TEST_FILE
