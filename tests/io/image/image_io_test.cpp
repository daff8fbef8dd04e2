#include "io/image/image_format.h"
#include "io/image/image_io.h"
#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}
Result<ImagePtr> decode(const std::string& bytes) {
    return read_image(std::span(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()), "memory");
}

// Noise, so that every part of the file matters.
std::vector<float> noise(size_t count) {
    std::mt19937 random(7);
    std::vector<float> values(count);
    for (float& v : values) v = float(random() % 256) / 255;
    return values;
}

LayeredImage layered(int width, int height) {
    const size_t pixels = size_t(width) * size_t(height);
    LayeredImage image{width, height, {}, {}};
    for (const char* name : {"R", "G", "B", "A", "albedo.R", "albedo.G", "albedo.B", "depth.Z"})
        image.channels.push_back({name, noise(pixels)});
    image.channels.push_back({"id.object", std::vector<float>(pixels, 16777215.0f), true});
    image.channels.push_back({"id.material", std::vector<float>(pixels, 3.0f), true});
    image.channels[0].values[0] = 1e30f;
    image.channels[1].values[0] = std::numeric_limits<float>::denorm_min();
    image.channels[2].values[0] = -2.5f;
    image.metadata = {{"blush:spp", "64"}, {"blush:settings", R"({"size":"4x3"})"}, {"blush:edits", std::string(100000, 'x')}};
    return image;
}

TEST(ImageIo, ExrKeepsEveryLayerAndTextBitForBit) {
    const TempFolder folder;
    const LayeredImage written = layered(5, 3);
    ASSERT_TRUE(write_exr(folder / "a.exr", written));
    const auto read = read_layers(folder / "a.exr");
    ASSERT_TRUE(read) << error_text(read);
    EXPECT_EQ(read->width, 5);
    EXPECT_EQ(read->height, 3);
    EXPECT_EQ(read->channels.size(), written.channels.size());
    for (const LayeredImage::Channel& channel : written.channels) {
        const LayeredImage::Channel* same = read->find(channel.name);
        ASSERT_TRUE(same) << channel.name;
        EXPECT_EQ(same->values, channel.values) << channel.name;
        EXPECT_EQ(same->is_uint, channel.is_uint) << channel.name;
    }
    for (const auto& [key, value] : written.metadata) EXPECT_EQ(read->metadata.at(key), value) << key;
    EXPECT_EQ(read->find("none"), nullptr);
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(ImageIo, ColorsAndLayersAreFoundAndSetByName) {
    LayeredImage image{1, 1, {{"R", {1}}, {"G", {2}}, {"B", {3}}, {"depth.Z", {4}}, {"denoised.Y", {5}}}, {}};
    EXPECT_EQ(image.find_color()[1]->name, "G");
    for (const LayeredImage::Channel* channel : image.find_color("denoised"))
        EXPECT_EQ(channel->name, "denoised.Y") << "grey is used for R, G and B";
    EXPECT_EQ(image.find_color("albedo")[0], nullptr);
    image.set({"depth.Z", {6}}, "R");
    image.set({"A", {7}}, "B");
    image.set({"last", {8}}, "none");
    std::vector<std::string> names;
    for (const LayeredImage::Channel& channel : image.channels) names.push_back(channel.name);
    EXPECT_EQ(names, (std::vector<std::string>{"R", "G", "B", "A", "depth.Z", "denoised.Y", "last"}));
    EXPECT_EQ(image.find("depth.Z")->values[0], 6) << "replaced in place";
}

TEST(ImageIo, ExrAsImageIsFloat) {
    const TempFolder folder;
    ASSERT_TRUE(write_exr(folder / "a.exr", layered(2, 2)));
    const auto image = read_image(folder / "a.exr");
    ASSERT_TRUE(image) << error_text(image);
    EXPECT_EQ((*image)->channels, 4);
    EXPECT_TRUE((*image)->bytes.empty());
    EXPECT_EQ((*image)->floats[0], 1e30f);
}

TEST(ImageIo, PngRoundsToTheNearestStepAndNanIsBlack) {
    const TempFolder folder;
    const std::vector<float> rgb = {0, 1, 0.5f, -3, 7, std::numeric_limits<float>::quiet_NaN()};
    ASSERT_TRUE(write_display_image(folder / "a.png", 2, 1, rgb, {{"blush:spp", "64"}}));
    const auto image = read_image(folder / "a.png");
    ASSERT_TRUE(image) << error_text(image);
    EXPECT_EQ((*image)->channels, 3);
    EXPECT_EQ((*image)->bytes, (std::vector<uint8_t>{0, 255, 128, 0, 255, 0}));
    EXPECT_EQ(read_layers(folder / "a.png")->metadata.at("blush:spp"), "64");
}

TEST(ImageIo, JpegIsCloseForASmoothImage) {
    const TempFolder folder;
    const std::vector<float> rgb(16 * 16 * 3, 0.5f);
    ASSERT_TRUE(write_display_image(folder / "a.JPG", 16, 16, rgb));
    const auto image = read_image(folder / "a.JPG");
    ASSERT_TRUE(image) << error_text(image);
    for (const uint8_t v : (*image)->bytes) EXPECT_NEAR(v, 128, 1); // constant: one coefficient per block, quantised finely
}

TEST(ImageIo, TruncatedFilesAreErrors) {
    const TempFolder folder;
    const std::vector<float> rgb = noise(32 * 32 * 3);
    ASSERT_TRUE(write_display_image(folder / "a.png", 32, 32, rgb));
    ASSERT_TRUE(write_display_image(folder / "a.jpg", 32, 32, rgb));
    ASSERT_TRUE(write_exr(folder / "a.exr", layered(32, 32)));
    for (const char* name : {"a.png", "a.jpg", "a.exr"}) {
        const std::string whole = bytes_of(folder / name);
        ASSERT_TRUE(decode(whole)) << name;
        for (const double part : {0.0, 0.01, 0.1, 0.5, 0.9})
            EXPECT_FALSE(decode(whole.substr(0, size_t(double(whole.size()) * part)))) << name << " " << part;
    }
    for (const char* name : {"a.png", "a.jpg"}) {
        const std::string whole = bytes_of(folder / name);
        EXPECT_FALSE(decode(whole.substr(0, whole.size() - 1))) << name;
    }
}

TEST(ImageIo, LimitsHoldBeforePixelsAreDecoded) {
    const TempFolder folder;
    ASSERT_TRUE(write_display_image(folder / "a.png", 8, 4, noise(8 * 4 * 3)));
    EXPECT_TRUE(read_image(folder / "a.png", {.max_side = 8, .max_pixels = 32}));
    EXPECT_NE(error_text(read_image(folder / "a.png", {.max_side = 7})).find("larger than the limit"), std::string::npos);
    EXPECT_NE(error_text(read_image(folder / "a.png", {.max_pixels = 31})).find("larger than the limit"), std::string::npos);
    // A header for 65535 x 65535 pixels with a few bytes of data.
    std::string png = bytes_of(folder / "a.png");
    std::fill_n(png.begin() + 18, 2, '\xff');
    std::fill_n(png.begin() + 22, 2, '\xff');
    EXPECT_FALSE(decode(png));
    // 3 GB of pixels, less than the limits, in 60 bytes.
    EXPECT_NE(error_text(decode("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16000 +X 16000\n")).find("more pixels than its bytes can hold"),
              std::string::npos);
}

TEST(ImageIo, RandomBytesFlippedDoNoHarm) {
    const TempFolder folder;
    ASSERT_TRUE(write_display_image(folder / "a.png", 9, 9, noise(9 * 9 * 3)));
    ASSERT_TRUE(write_display_image(folder / "a.jpg", 9, 9, noise(9 * 9 * 3)));
    ASSERT_TRUE(write_exr(folder / "a.exr", layered(9, 9)));
    write_bytes(folder / "a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 9 +X 9\n" + std::string(9 * 9 * 4, '\x81'));
    ASSERT_TRUE(read_image(folder / "a.hdr"));
    std::mt19937 random(3);
    for (const char* name : {"a.png", "a.jpg", "a.exr", "a.hdr"}) {
        const std::string whole = bytes_of(folder / name);
        for (int i = 0; i < 300; ++i) {
            std::string broken = whole;
            broken[random() % std::min<size_t>(broken.size(), 2000)] = char(random());
            const auto image =
                read_image(std::span(reinterpret_cast<const uint8_t*>(broken.data()), broken.size()), name, {.max_pixels = 1 << 20});
            if (image) {
                EXPECT_EQ(std::max((*image)->bytes.size(), (*image)->floats.size()),
                          size_t((*image)->width * (*image)->height * (*image)->channels));
            }
        }
    }
}

TEST(ImageIo, UnknownFormatsAndBadRequestsAreErrors) {
    const TempFolder folder;
    EXPECT_FALSE(decode("GIF89a and more"));
    EXPECT_FALSE(decode(""));
    EXPECT_FALSE(write_display_image(folder / "a.gif", 1, 1, noise(3)));
    EXPECT_FALSE(write_display_image(folder / "a.png", 2, 1, noise(3)));
    EXPECT_FALSE(write_exr(folder / "a.exr", LayeredImage{}));
    EXPECT_FALSE(write_exr(folder / "a.exr", LayeredImage{2, 2, {{"R", {1, 2, 3}}}, {}}));
    const auto written = write_exr(folder / "none/a.exr", layered(2, 2));
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().file, (folder / "none/a.exr").string());
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(JpegEnd, ThumbnailsDoNotCount) {
    // Start, an application segment of 6 bytes that holds an end marker, then nothing more.
    std::vector<uint8_t> bytes = {0xff, 0xd8, 0xff, 0xe1, 0x00, 0x06, 0xff, 0xd9, 0x00, 0x00};
    EXPECT_FALSE(is_complete_jpeg(bytes));
    bytes.insert(bytes.end(), {0xff, 0xd9});
    EXPECT_TRUE(is_complete_jpeg(bytes));
}

} // namespace
} // namespace blush::test::TEST_FILE
