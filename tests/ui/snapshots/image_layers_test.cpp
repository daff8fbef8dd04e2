// EXR files from other programs: grouping channels to layers, display of layers, and invalid files.
#include "core/files.h"
#include "tests/support/process.h"
#include "ui/snapshots/image_layers.h"
#include "ui/snapshots/snapshots_view.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <limits>

namespace blush::TEST_FILE {
namespace {

using Kind = ImageLayer::Kind;

LayeredImage image_of(std::vector<std::string> names, int width = 2, int height = 1) {
    LayeredImage image{width, height, {}, {}};
    float value = 0;
    for (const std::string& name : names) {
        LayeredImage::Channel channel{name, std::vector<float>(size_t(width) * size_t(height), value)};
        channel.values.back() = value + 1;
        value += 2;
        image.channels.push_back(channel);
    }
    return image;
}
std::vector<std::string> names_of(const std::vector<ImageLayer>& layers) {
    std::vector<std::string> names;
    for (const ImageLayer& l : layers) names.push_back(l.name);
    return names;
}
using Names = std::vector<std::string>;

TEST(ImageLayers, GroupChannelsByName) {
    const std::vector<ImageLayer> layers =
        layers_of({image_of({"Z", "diffuse.B", "diffuse.G", "diffuse.R", "A", "B", "G", "R", "N.X", "N.Y", "N.Z", "crypto00.r",
                             "crypto00.g", "crypto00.b", "crypto00.a", "beauty.R", "mask.Y"})});
    EXPECT_EQ(names_of(layers), (Names{"Beauty", "Z", "diffuse", "N", "crypto00", "beauty.R", "mask.Y"}));
    EXPECT_EQ(layers[0].channel, (std::array<int, 4>{7, 6, 5, 4})) << "red first, alpha last";
    EXPECT_EQ(layers[0].channels, "R, G, B, A");
    EXPECT_EQ(layers[2].channel[3], -1);
    EXPECT_EQ(layers[3].kind, Kind::vector);
    EXPECT_EQ(layers[4].channel, (std::array<int, 4>{11, 12, 13, 14}));
    EXPECT_EQ(layers[5].kind, Kind::number) << "red alone is no colour";
    EXPECT_TRUE(layers_of({LayeredImage{1, 1, {}, {}}}).empty());
}

TEST(ImageLayers, NamePartsOfAFile) {
    std::vector<LayeredImage> parts{image_of({"Y"}), image_of({"R", "G", "B"})};
    parts[1].part = "rgb";
    EXPECT_EQ(names_of(layers_of(parts)), (Names{"rgb: Beauty", "Part 1: Y"}));
    EXPECT_EQ(layers_of(parts)[0].part, 1u);
}

TEST(ImageLayers, AreDisplayedByKind) {
    ImageLayers p{"image.exr", {image_of({"R", "G", "B", "Z", "P.X", "P.Y", "P.Z"})}, {}};
    p.parts[0].channels[3].values = {5, 9};
    p.parts[0].channels[0].values[1] = std::numeric_limits<float>::quiet_NaN();
    p.layers = layers_of(p.parts);
    EXPECT_EQ(frame_of(p)->rgba, (std::vector<float>{0, 2, 4, 1, 0, 3, 5, 1}));
    EXPECT_EQ(range_text(p), "");
    p.chosen = 1;
    EXPECT_EQ(frame_of(p)->rgba, (std::vector<float>{0, 0, 0, 1, 1, 1, 1, 1}));
    EXPECT_EQ(range_text(p), "from 5 to 9");
    p.parts[0].channels[3].values = {1e30f, std::numeric_limits<float>::infinity()};
    EXPECT_EQ(range_text(p), "no numbers") << "infinite depth";
    EXPECT_EQ(frame_of(p)->rgba[4], 0);
    p.chosen = 2;
    EXPECT_EQ(frame_of(p)->rgba[0], 4.5f) << "8 / 2 + 1 / 2";
    LayeredImage ids = image_of({"id"});
    ids.channels[0].is_uint = true;
    ids.channels[0].words = {0, 3};
    ImageLayers q{"ids.exr", {ids}, layers_of({ids})};
    EXPECT_EQ(q.layers[0].kind, Kind::id);
    EXPECT_EQ(frame_of(q)->rgba[0], 0);
    EXPECT_NE(frame_of(q)->rgba[4], 0);
}

TEST(ImageLayers, RecogniseAPanorama) {
    const auto opened = [](LayeredImage image) { return ImageLayers{"p.exr", {image}, layers_of({image})}; };
    EXPECT_TRUE(is_panorama(opened(image_of({"R", "G", "B"}, 4, 2))));
    EXPECT_TRUE(is_panorama(opened(image_of({"R", "G", "B", "A"}, 4, 2))));
    EXPECT_FALSE(is_panorama(opened(image_of({"R", "G", "B"}, 4, 3))));
    EXPECT_FALSE(is_panorama(opened(image_of({"R", "G", "B", "Z"}, 4, 2))));
}

class ImageFile : public testing::Test {
protected:
    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "layers.exr";
};

TEST_F(ImageFile, OpensWithAllItsChannels) {
    LayeredImage image = image_of({"R", "G", "B", "depth.Z", "id"}, 3, 2);
    image.channels[0].is_half = true;
    image.channels[4].is_uint = true;
    image.channels[4].words = {1, 2, 3, 4, 5, 4000000000u};
    ASSERT_TRUE(write_exr(file_, image));
    const auto opened = open_image_layers(file_);
    ASSERT_TRUE(opened) << opened.error().text();
    EXPECT_EQ(names_of((*opened)->layers), (Names{"Beauty", "id", "depth.Z"})) << "integers are first in the file";
    EXPECT_EQ((*opened)->parts[0].channels.size(), 5u);
    Snapshot s;
    s.layers = *opened;
    s.choose_layer(1);
    EXPECT_EQ(s.images.frame->width, 3);
    EXPECT_NE(s.figures().find("3 layers"), std::string::npos);
}

TEST_F(ImageFile, HasADisplayWindow) {
    LayeredImage image = image_of({"R", "G", "B"}, 8, 4);
    ASSERT_TRUE(write_exr(file_, image));
    EXPECT_FALSE(read_layers(file_)->display_window);
    image.display_window = PixelRect{2, 0, 6, 4};
    ASSERT_TRUE(write_exr(file_, image));
    const Result<LayeredImage> read = read_layers(file_);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->width, 8);
    EXPECT_EQ(read->display_window, image.display_window);
    ASSERT_TRUE(write_exr(file_, *read));
    EXPECT_EQ(read_layers(file_)->display_window, image.display_window);
}

TEST_F(ImageFile, InvalidFileIsOneError) {
    ASSERT_TRUE(write_exr(file_, image_of({"R", "G", "B", "Z"}, 16, 16)));
    const Result<std::vector<uint8_t>> bytes = read_file(file_, 1 << 20);
    ASSERT_TRUE(bytes);
    int refused = 0;
    for (size_t size = 0; size < bytes->size(); size += 7) {
        ASSERT_TRUE(write_file(file_, std::span(*bytes).first(size)));
        const auto opened = open_image_layers(file_);
        if (!opened) {
            EXPECT_EQ(opened.error().text().find('\n'), std::string::npos);
            ++refused;
        }
    }
    EXPECT_GT(refused, int(bytes->size() / 7) / 2);
    for (size_t i = 8; i < std::min<size_t>(bytes->size(), 400); ++i) {
        std::vector<uint8_t> changed = *bytes;
        changed[i] ^= 0xff;
        ASSERT_TRUE(write_file(file_, changed));
        if (const auto opened = open_image_layers(file_); opened) { EXPECT_FALSE((*opened)->layers.empty()); }
    }
}

} // namespace
} // namespace blush::TEST_FILE
