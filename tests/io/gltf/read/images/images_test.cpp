// Texture images: formats, sharing, memory limit.
#include "core/box_filter.h"
#include "core/srgb.h"
#include "io/image/image_io.h"
#include "io/image/image_shrinker.h"
#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

namespace blush::test::TEST_FILE {
namespace {

// 2 x 1 pixels, red and green, without loss.
constexpr const char* webp_base64 = "UklGRh4AAABXRUJQVlA4TBEAAAAvAQAAAA+w//Mf8x8VMqL/AQA=";
constexpr const char* ktx2_magic = "\xabKTX 20\xbb\r\n\x1a\n";
const std::vector<uint8_t> red_green = {255, 0, 0, 0, 255, 0};

std::string png_of(const Image& image) {
    const auto bytes = encode_png(image);
    EXPECT_TRUE(bytes);
    return {bytes->begin(), bytes->end()};
}
// Alternating black and white rows, all opaque.
Image stripes(int width, int height) {
    Image image{.width = width, .height = height, .channels = 3, .bytes = {}, .floats = {}};
    for (int i = 0; i < width * height * 3; ++i) image.bytes.push_back(i / (3 * width) % 2 ? 255 : 0);
    return image;
}

// Each image in its own texture; the first is a base colour, the second a metallic-roughness.
GltfBuilder with_images(const std::vector<Json>& images) {
    GltfBuilder b;
    for (const Json& image : images) b.add("textures", {{"source", b.add("images", image)}});
    Json pbr{{"baseColorTexture", {{"index", 0}}}};
    if (images.size() > 1) pbr["metallicRoughnessTexture"] = {{"index", 1}};
    b.add("materials", {{"pbrMetallicRoughness", pbr}});
    return b;
}
Json png_uri(const Image& image) { return {{"uri", "data:image/png;base64," + base64(png_of(image))}}; }
ImagePtr image_of(const Result<ImportedScene>& imported, size_t texture) { return imported->scene.textures.entries()[texture].value.image; }

TEST(GltfImages, WebpIsPreferredToItsFallback) {
    GltfBuilder b = with_images({png_uri(stripes(4, 4)), {{"uri", std::string("data:image/webp;base64,") + webp_base64}}});
    b.json["textures"][0]["extensions"] = {{"EXT_texture_webp", {{"source", 1}}}};
    b.json["extensionsUsed"] = b.json["extensionsRequired"] = {"EXT_texture_webp"};
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_EQ(image_of(imported, 0)->bytes, red_green);
    EXPECT_EQ(imported->report.extensions_honoured, std::vector<std::string>{"EXT_texture_webp"});
}

TEST(GltfImages, Ktx2IsReportedAndItsFallbackRead) {
    const Json ktx2{{"uri", "data:image/ktx2;base64," + base64(std::string(ktx2_magic) + std::string(80, '\0'))}};
    GltfBuilder b = with_images({png_uri(stripes(4, 4)), ktx2});
    b.json["textures"][0]["extensions"] = {{"KHR_texture_basisu", {{"source", 1}}}};
    b.json["textures"][1] = {{"extensions", {{"KHR_texture_basisu", {{"source", 1}}}}}};
    b.json["extensionsUsed"] = b.json["extensionsRequired"] = {"KHR_texture_basisu"};
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    ASSERT_EQ(imported->scene.textures.size(), 1u);
    EXPECT_EQ(image_of(imported, 0)->width, 4);
    EXPECT_TRUE(reports(imported->report, "the fallback image is read"));
    EXPECT_TRUE(reports(imported->report, "ignored: KTX2 cannot be decoded"));

    GltfBuilder direct = with_images({ktx2});
    const auto shown = import_built(direct);
    ASSERT_TRUE(shown) << error_text(shown);
    EXPECT_TRUE(reports(shown->report, "KTX2 cannot be decoded: images[0]"));
}

TEST(GltfImages, FormatIsDetectedFromTheBytes) {
    GltfBuilder b;
    std::string webp;
    for (const uint8_t byte : std::initializer_list<uint8_t>{0x52, 0x49, 0x46, 0x46, 0x1e, 0,    0,    0,    0x57, 0x45, 0x42, 0x50, 0x56,
                                                             0x50, 0x38, 0x4c, 0x11, 0,    0,    0,    0x2f, 0x01, 0,    0,    0,    0x0f,
                                                             0xb0, 0xff, 0xf3, 0x1f, 0xf3, 0x1f, 0x15, 0x32, 0xa2, 0xff, 0x01, 0x00})
        webp += char(byte);
    ASSERT_EQ(base64(webp), webp_base64);
    b.add("textures", {{"source", b.add("images", {{"bufferView", b.buffer_view(webp)}, {"mimeType", "image/jpeg"}})}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_EQ(image_of(imported, 0)->bytes, red_green);
    EXPECT_TRUE(reports(imported->report, "declared as jpeg but is webp"));
}

TEST(GltfImages, EqualBytesShareAnImage) {
    const auto imported = import_built(with_images({png_uri(stripes(8, 8)), png_uri(stripes(8, 8)), png_uri(stripes(8, 4))}));
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_EQ(image_of(imported, 0), image_of(imported, 1));
    EXPECT_NE(image_of(imported, 0), image_of(imported, 2));
}

TEST(GltfImages, SixteenBitsStaySixteenBits) {
    Image deep{.width = 4, .height = 1, .channels = 3, .bytes = {}, .floats = {}};
    const int words[] = {0, 1, 2, 255, 256, 257, 32767, 32768, 40000, 65533, 65534, 65535};
    for (const int word : words) deep.floats.push_back(float(word) / 65535);
    const auto imported = import_built(with_images({png_uri(deep)}));
    ASSERT_TRUE(imported) << error_text(imported);
    ASSERT_EQ(image_of(imported, 0)->floats.size(), std::size(words));
    for (size_t i = 0; i < std::size(words); ++i) EXPECT_EQ(std::lround(double(image_of(imported, 0)->floats[i]) * 65535), words[i]);
}

TEST(GltfImages, LargestAreHalvedUntilAllFitIntoMemory) {
    // 12288 bytes of colour, 12288 of data and 192 more fit into 6400 if both large images are halved once.
    const GltfBuilder b = with_images({png_uri(stripes(64, 64)), png_uri(stripes(128, 32)), png_uri(stripes(8, 8))});
    ImportOptions options;
    options.texture_bytes = 6400;
    const auto imported = import_built(b, options);
    ASSERT_TRUE(imported) << error_text(imported);
    const ImagePtr color = image_of(imported, 0), numbers = image_of(imported, 1), small = image_of(imported, 2);
    EXPECT_EQ(color->width, 32);
    EXPECT_EQ(color->height, 32);
    EXPECT_EQ(numbers->width, 64);
    EXPECT_EQ(numbers->height, 16);
    EXPECT_EQ(small->width, 8);
    EXPECT_LE(int64_t(color->bytes.size() + numbers->bytes.size() + small->bytes.size()), options.texture_bytes);
    const auto half_the_light = uint8_t(std::lround(255 * srgb_from_linear(0.5f)));
    for (const uint8_t v : color->bytes) ASSERT_EQ(v, half_the_light);
    for (const uint8_t v : numbers->bytes) ASSERT_EQ(v, 128);
    EXPECT_TRUE(reports(imported->report, "reduced 1 times, from 64 x 64 to 32 x 32"));
    EXPECT_TRUE(reports(imported->report, "reduced 1 times, from 128 x 32 to 64 x 16"));
    EXPECT_FALSE(reports(import_built(b)->report, "reduced"));
}

TEST(GltfImages, ProgressIsReportedOnTheImportingThread) {
    std::vector<Json> images;
    for (int i = 1; i <= 12; ++i) images.push_back(png_uri(stripes(i, i)));
    const std::thread::id here = std::this_thread::get_id();
    double last = 0;
    bool counted = false;
    ImportOptions options;
    options.on_progress = [&](double fraction, const std::string& what) {
        EXPECT_EQ(std::this_thread::get_id(), here);
        EXPECT_GE(fraction, last);
        last = fraction;
        counted |= what.find(" of 12") != std::string::npos;
    };
    ASSERT_TRUE(import_built(with_images(images), options));
    EXPECT_TRUE(counted);
    EXPECT_EQ(last, 1);
}

TEST(ImageShrinker, KeepsTheMeanOfAnySize) {
    for (const auto& [width, height] : {std::pair{8, 8}, {7, 5}, {1, 9}, {13, 1}, {33, 17}})
        for (int halvings = 0; halvings < 5; ++halvings) {
            std::vector<float> source;
            double sum = 0;
            for (int i = 0; i < width * height; ++i) {
                source.push_back(float((i * 37) % 11));
                sum += source.back();
            }
            ImageShrinker shrinker({width, height, 1, true, false}, halvings);
            for (int y = 0; y < height; ++y) shrinker.add(std::span<const float>(source).subspan(size_t(y * width), size_t(width)));
            const ImagePtr image = std::move(shrinker).image();
            ASSERT_EQ(image->width, halved(width, halvings));
            ASSERT_EQ(image->height, halved(height, halvings));
            ASSERT_EQ(image->floats.size(), size_t(image->width * image->height));
            double mean = 0;
            for (const float v : image->floats) mean += double(v) / double(image->floats.size());
            // Sums of positive numbers in single precision.
            EXPECT_NEAR(mean, sum / (width * height), 1e-6 * 11 * 4) << width << " x " << height << " halved " << halvings;
        }
}

} // namespace
} // namespace blush::test::TEST_FILE
