#include "io/snapshot.h"
#include "io_gltf_builder.h"

#include <gtest/gtest.h>

#include <map>

namespace blush::test {
namespace {

struct Planes {
    std::vector<float> rgba = {1, 2, 3, 1, 4, 5, 6, 0};
    std::vector<Vec3> albedo = {{0.1f, 0.2f, 0.3f}, {0.4f, 0.5f, 0.6f}}, normal = {{0, 1, 0}, {0, 0, 0}},
                      error = {{0.01f, 0.02f, 0.03f}, {0, 0, 0}};
    std::vector<float> depth = {2.5f, 0}, samples = {64, 64}, denoised = {9, 8, 7, 6, 5, 4};
    std::vector<uint32_t> object = {7, 0}, material = {3, 0};
};

SnapshotInput full_input(const Planes& p) {
    SnapshotInput input{2, 1, p.rgba, p.denoised, p.albedo, p.normal, p.depth, p.error, p.samples, p.object, p.material, {}, {}};
    SnapshotMetadata& m = input.metadata;
    m.version = "0.1.0";
    m.scene = "cornell.gltf";
    m.scene_hash = "0123456789abcdef";
    m.camera = "Camera";
    m.spp = 64;
    m.first_sample = 0;
    m.last_sample = 64;
    m.seed = 9;
    m.seconds = 1.0 / 3;
    m.error = "relmse 0.001";
    m.denoised = "rt_hdr, float32";
    m.settings.max_bounces = 3;
    m.edits = R"({"format":1})";
    m.partial = true;
    return input;
}

TEST(Snapshot, ChannelsAndMetadataAreThoseOfTheContractAndComeBackFromAFile) {
    const Planes planes;
    const SnapshotInput input = full_input(planes);
    const auto image = make_snapshot(input);
    ASSERT_TRUE(image) << error_text(image);
    std::vector<std::string> names;
    for (const LayeredImage::Channel& channel : image->channels) names.push_back(channel.name);
    EXPECT_EQ(names, (std::vector<std::string>{"R", "G", "B", "A", "denoised.R", "denoised.G", "denoised.B", "albedo.R", "albedo.G",
                                               "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z", "error.R", "error.G", "error.B", "samples.Y", "id.object", "id.material"}));
    const TempFolder folder;
    ASSERT_TRUE(write_exr(folder / "a.exr", *image));
    const auto read = read_layers(folder / "a.exr");
    ASSERT_TRUE(read) << error_text(read);
    EXPECT_EQ(read->channels.size(), names.size());
    EXPECT_EQ(read->find("G")->values, (std::vector<float>{2, 5}));
    EXPECT_EQ(read->find("denoised.G")->values, (std::vector<float>{8, 5}));
    EXPECT_EQ(read->find("albedo.B")->values, (std::vector<float>{0.3f, 0.6f}));
    EXPECT_EQ(read->find("normal.Y")->values, (std::vector<float>{1, 0}));
    EXPECT_EQ(read->find("id.object")->values, (std::vector<float>{7, 0}));
    EXPECT_TRUE(read->find("id.object")->is_uint);
    EXPECT_EQ(read->metadata.at("blush:samples"), "0:64");
    const auto metadata = read_snapshot_metadata(*read);
    ASSERT_TRUE(metadata) << error_text(metadata);
    EXPECT_EQ(*metadata, input.metadata);
}

TEST(Snapshot, AbsentPlanesAreLeftOutAndWrongOnesAreErrors) {
    const Planes planes;
    SnapshotInput input;
    input.width = 2;
    input.height = 1;
    EXPECT_FALSE(make_snapshot(input));
    input.rgba = planes.rgba;
    ASSERT_TRUE(make_snapshot(input));
    EXPECT_EQ(make_snapshot(input)->channels.size(), 4u);
    const std::vector<float> three(3);
    input.depth = three;
    EXPECT_NE(error_text(make_snapshot(input)).find("wrong size, depth.Z"), std::string::npos);
    input.depth = {};
    const std::vector<uint32_t> large = {1u << 24, 0};
    input.object_id = large;
    EXPECT_NE(error_text(make_snapshot(input)).find("too large"), std::string::npos);
}

TEST(Snapshot, ForeignAndBrokenMetadataAreErrors) {
    LayeredImage image;
    EXPECT_FALSE(read_snapshot_metadata(image));
    image.metadata = {{"blush:version", "0.1.0"}};
    EXPECT_TRUE(read_snapshot_metadata(image));
    for (const auto& [key, value] : std::map<std::string, std::string>{{"blush:spp", "many"},
                                                                       {"blush:samples", "0"},
                                                                       {"blush:samples", "a:b"},
                                                                       {"blush:seed", "-1"},
                                                                       {"blush:settings", "{"},
                                                                       {"blush:seconds", "1s"}}) {
        LayeredImage broken = image;
        broken.metadata[key] = value;
        EXPECT_FALSE(read_snapshot_metadata(broken)) << key;
    }
}

} // namespace
} // namespace blush::test
