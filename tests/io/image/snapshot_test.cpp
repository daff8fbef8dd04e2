#include "io/image/lossless_channels.h"
#include "io/image/snapshot.h"
#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <map>

namespace blush::test::TEST_FILE {
namespace {

struct Planes {
    std::vector<float> rgba = {1, 2, 3, 1, 4, 5, 6, 0};
    std::vector<Vec3> albedo = {{0.1f, 0.2f, 0.3f}, {0.4f, 0.5f, 0.6f}}, normal = {{0, 1, 0}, {0, 0, 0}},
                      error = {{0.01f, 0.02f, 0.03f}, {0, 0, 0}};
    std::vector<float> depth = {2.5f, 0}, samples = {64, 64}, denoised = {9, 8, 7, 6, 5, 4};
    std::vector<uint32_t> object = {7, 0}, material = {3, 0};
};

SnapshotInput full_input(const Planes& p) {
    SnapshotInput input{2,          1,  p.rgba, p.denoised, p.albedo, p.normal, p.depth, p.error, p.samples, p.object,
                        p.material, {}, {},     {},         {},       {},       {},      false,   {}};
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

TEST(Snapshot, ChannelsAndMetadataRoundTrip) {
    const Planes planes;
    const SnapshotInput input = full_input(planes);
    const auto image = make_snapshot(input);
    ASSERT_TRUE(image) << error_text(image);
    std::vector<std::string> names;
    for (const LayeredImage::Channel& channel : image->channels) names.push_back(channel.name);
    EXPECT_EQ(names, (std::vector<std::string>{"R",        "G",        "B",        "A",         "denoised.R", "denoised.G", "denoised.B",
                                               "albedo.R", "albedo.G", "albedo.B", "normal.X",  "normal.Y",   "normal.Z",   "depth.Z",
                                               "error.R",  "error.G",  "error.B",  "samples.Y", "id.object",  "id.material"}));
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
    const auto metadata = read_snapshot_metadata(read->metadata);
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
    EXPECT_FALSE(read_snapshot_metadata(image.metadata));
    image.metadata = {{"blush:version", "0.1.0"}};
    EXPECT_TRUE(read_snapshot_metadata(image.metadata));
    for (const auto& [key, value] : std::vector<std::pair<std::string, std::string>>{{"blush:spp", "many"},
                                                                                     {"blush:samples", "0"},
                                                                                     {"blush:samples", "a:b"},
                                                                                     {"blush:seed", "-1"},
                                                                                     {"blush:settings", "{"},
                                                                                     {"blush:seconds", "1s"}}) {
        LayeredImage broken = image;
        broken.metadata[key] = value;
        EXPECT_FALSE(read_snapshot_metadata(broken.metadata)) << key;
    }
}

// Possible sums of samples, and unusual bit patterns.
const std::vector<double> awkward_sums{
    0.0, -0.0, 1.0 / 3, 1e300, 5e-324, -1e-200, std::numeric_limits<double>::infinity(), 4503599627370497.5};

TEST(Snapshot, LosslessPlanesRoundTripExactly) {
    std::vector<double> low(awkward_sums.rbegin(), awkward_sums.rend());
    const std::vector<LosslessPlane> planes{
        {"even.R", awkward_sums, {}, low}, {"even.count", {}, {0, 1, 16777217, 4294967295u, 5, 6, 7, 8}}, {"normal.X", awkward_sums}};
    const std::vector<float> rgba(8 * 4, 0.5f);
    SnapshotInput input;
    input.width = 4;
    input.height = 2;
    input.rgba = rgba;
    input.film = planes;
    const auto image = make_snapshot(input);
    ASSERT_TRUE(image) << error_text(image);
    const TempFolder folder;
    ASSERT_TRUE(write_exr(folder / "a.exr", *image));
    auto read = read_layers(folder / "a.exr");
    ASSERT_TRUE(read) << error_text(read);
    EXPECT_TRUE(take_lossless_planes(*read, "id").empty());
    std::vector<LosslessPlane> back = take_lossless_planes(*read, "film");
    ASSERT_EQ(back.size(), 3u);
    std::ranges::sort(back, {}, &LosslessPlane::name);
    EXPECT_EQ(back[1], planes[1]);
    const auto bits = [](const std::vector<double>& values) {
        std::vector<uint64_t> result;
        for (const double v : values) result.push_back(std::bit_cast<uint64_t>(v));
        return result;
    };
    EXPECT_EQ(bits(back[0].sums), bits(awkward_sums));
    EXPECT_EQ(bits(back[0].low), bits(low));
    EXPECT_EQ(bits(back[2].sums), bits(awkward_sums));
    EXPECT_TRUE(back[2].low.empty());
    EXPECT_TRUE(read->find("film.even.R.high")->words.empty()) << "the image has lost them";

    std::vector<LosslessPlane> wrong = planes;
    wrong[0].sums.pop_back();
    input.film = wrong;
    EXPECT_NE(error_text(make_snapshot(input)).find("wrong size, film.even.R"), std::string::npos);
}

TEST(Snapshot, HalfIsForColoursAlone) {
    Planes planes;
    planes.rgba = {1, 1.0f / 3, 3e-6f, 1, 4, -70000, 1e30f, 0.5f};
    SnapshotInput input = full_input(planes);
    input.half = true;
    const auto image = make_snapshot(input);
    ASSERT_TRUE(image) << error_text(image);
    EXPECT_EQ(count_beyond_half(*image), 2);
    const TempFolder folder;
    ASSERT_TRUE(write_exr(folder / "half.exr", *image));
    input.half = false;
    ASSERT_TRUE(write_exr(folder / "float.exr", *make_snapshot(input)));
    const auto half = read_layers(folder / "half.exr"), whole = read_layers(folder / "float.exr");
    ASSERT_TRUE(half && whole);
    EXPECT_EQ(whole->find("G")->values, (std::vector<float>{1.0f / 3, -70000}));
    // 11 bits of precision, rounded to the nearest; subnormal below 2^-14.
    EXPECT_EQ(half->find("R")->values, (std::vector<float>{1, 4}));
    EXPECT_EQ(half->find("G")->values, (std::vector<float>{1365.0f / 4096, -max_half}));
    EXPECT_EQ(half->find("B")->values, (std::vector<float>{50.0f / 16777216, max_half}));
    EXPECT_EQ(half->find("depth.Z")->values, planes.depth);
    EXPECT_EQ(half->find("id.object")->words, planes.object);
    const auto metadata = read_metadata(folder / "half.exr");
    ASSERT_TRUE(metadata) << error_text(metadata);
    EXPECT_EQ(*metadata, half->metadata);
}

TEST(Snapshot, IsDistinguishedFromPlainRenders) {
    SnapshotMetadata m = full_input({}).metadata;
    EXPECT_FALSE(is_snapshot(snapshot_texts(m))) << "a plain render may be used as an environment map";
    EXPECT_FALSE(is_snapshot({}));
    m.view = ViewSettings{.exposure_ev = 1.5f, .gamma = 1.1f, .display = {}, .view = "Raw"};
    m.name = "Key only";
    m.note = "two\nlines, \xc3\xa4";
    m.scene_file = "../scenes/cornell.gltf";
    EXPECT_TRUE(is_snapshot(snapshot_texts(m)));
    const auto back = read_snapshot_metadata(snapshot_texts(m));
    ASSERT_TRUE(back) << error_text(back);
    EXPECT_EQ(*back, m);
    std::map<std::string, std::string> broken = snapshot_texts(m);
    broken["blush:view"] = R"({"gamma": "bright"})";
    EXPECT_FALSE(read_snapshot_metadata(broken));
}

// Zeros compress to almost nothing: sizes are checked before allocation.
TEST(Snapshot, AFileOfTooManyPixelsIsRefusedUnread) {
    const Planes planes;
    const TempFolder folder;
    ASSERT_TRUE(write_exr(folder / "a.exr", *make_snapshot(full_input(planes))));
    const auto read = read_layers(folder / "a.exr", {.max_side = 65536, .max_pixels = 1});
    EXPECT_NE(error_text(read).find("larger than the limit"), std::string::npos);
    EXPECT_NE(error_text(read_metadata(folder / "a.exr", {.max_side = 1, .max_pixels = 100})).find("larger than the limit"),
              std::string::npos);
}

} // namespace
} // namespace blush::test::TEST_FILE
