// `blush merge` and `blush render --continue`: partial renders combine to the samples of one render.
#include "io/image/snapshot.h"
#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <utility>

namespace blush::TEST_FILE {
namespace {

using test::blush;
using test::Finished;
using test::scene_file;
using test::TemporaryFolder;

using Arguments = std::vector<std::string>;

Arguments with(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}
Arguments tiny() { return {"render", scene_file("cornell"), "--size", "24x16", "--quiet"}; }
Arguments tiny(const std::string& output) { return with(tiny(), {"-o", output}); }
const Arguments all_layers{"--layers", "albedo,normal,depth,error,samples,id,bounces=3,film"};

void expect_done(const Arguments& arguments) {
    const Finished finished = blush(arguments);
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
}

// Every channel has the same bits.
void expect_same_channels(const std::string& file, const std::string& expected_file) {
    const Result<LayeredImage> image = read_layers(file), expected = read_layers(expected_file);
    ASSERT_TRUE(image) << image.error().text();
    ASSERT_TRUE(expected) << expected.error().text();
    EXPECT_EQ(image->channels.size(), expected->channels.size());
    for (const LayeredImage::Channel& channel : expected->channels) {
        const LayeredImage::Channel* found = image->find(channel.name);
        ASSERT_TRUE(found) << channel.name;
        EXPECT_TRUE(found->values == channel.values) << channel.name;
        EXPECT_TRUE(found->words == channel.words) << channel.name;
    }
}

TEST(Continue, EqualsAnUninterruptedRender) {
    const TemporaryFolder folder;
    expect_done(with(with(tiny(folder / "whole.exr"), all_layers), {"--spp", "24", "--seed", "3", "--max-bounces", "4"}));
    expect_done(with(with(tiny(folder / "begun.exr"), all_layers), {"--spp", "11", "--seed", "3", "--max-bounces", "4"}));
    expect_done(
        with({"render", scene_file("cornell"), "--continue", folder / "begun.exr", "--spp", "24", "-o", folder / "done.exr", "--quiet"},
             all_layers));
    expect_same_channels(folder / "done.exr", folder / "whole.exr");
    const auto metadata = read_snapshot_metadata(read_layers(folder / "done.exr")->metadata);
    ASSERT_TRUE(metadata);
    EXPECT_EQ(metadata->spp, 24);
    EXPECT_EQ(metadata->last_sample, 24);
    EXPECT_EQ(metadata->settings.seed, 3u);
}

TEST(Continue, ResumesAdaptiveSamplingAndAnotherEnvironment) {
    const TemporaryFolder folder;
    const Arguments options{"--adaptive", "on", "--env", "constant=0.2,0.3,0.4", "--layers", "samples,film"};
    expect_done(with(with(tiny(folder / "whole.exr"), options), {"--spp", "40"}));
    expect_done(with(with(tiny(folder / "begun.exr"), options), {"--spp", "20"}));
    expect_done({"render", scene_file("cornell"), "--continue", folder / "begun.exr", "--spp", "40", "-o", folder / "done.exr", "--quiet",
                 "--layers", "samples,film"});
    expect_same_channels(folder / "done.exr", folder / "whole.exr");
}

TEST(Continue, ErrorsNameTheReason) {
    const TemporaryFolder folder;
    const auto fails = [&](const Arguments& arguments, int code, const std::string& why) {
        const Finished finished = blush(arguments);
        EXPECT_EQ(finished.exit_code, code) << finished.err;
        EXPECT_NE(finished.err.find(why), std::string::npos) << finished.err;
        EXPECT_TRUE(test::is_one_line(finished.err)) << finished.err;
    };
    expect_done(with(tiny(folder / "plain.exr"), {"--spp", "2"}));
    expect_done(with(tiny(folder / "film.exr"), {"--spp", "2", "--layers", "film"}));
    const auto resume = [&](const std::string& scene, const std::string& file) {
        return Arguments{"render", scene_file(scene), "--continue", folder / file, "--spp", "4", "-o", folder / "out.exr", "--quiet"};
    };
    fails(resume("cornell", "plain.exr"), 1, "without the samples");
    fails(resume("furnace", "film.exr"), 1, "another scene");
    fails(resume("cornell", "nowhere.exr"), 1, "nowhere.exr");
    fails(with(resume("cornell", "film.exr"), {"--seed", "4"}), 2, "only --spp, --time and --error");
    fails(with(resume("cornell", "film.exr"), {"--layers", "albedo"}), 1, "lack the plane \"albedo.R\"");
}

// Renders the ranges, with all layers, and merges them in this order.
void merge_ranges(const TemporaryFolder& folder, const Arguments& render, const std::vector<std::pair<int, int>>& ranges,
                  const std::string& output) {
    Arguments merge{"merge", "--quiet", "-o", output};
    for (const auto& [first, last] : ranges) {
        const std::string range = std::to_string(first) + ":" + std::to_string(last), file = folder / (range + ".exr");
        if (!std::filesystem::exists(file)) expect_done(with(render, {"--samples", range, "-o", file}));
        merge.push_back(file);
    }
    expect_done(merge);
}

TEST(Merge, OfFilmStatesIsTheWholeRender) {
    const TemporaryFolder folder;
    expect_done(with(with(tiny(folder / "whole.exr"), all_layers), {"--samples", "0:14"}));
    merge_ranges(folder, with(tiny(), all_layers), {{5, 12}, {0, 5}, {12, 14}}, folder / "merged.exr");
    expect_same_channels(folder / "merged.exr", folder / "whole.exr");
    const auto metadata = read_snapshot_metadata(read_layers(folder / "merged.exr")->metadata);
    ASSERT_TRUE(metadata);
    EXPECT_EQ(metadata->first_sample, 0);
    EXPECT_EQ(metadata->last_sample, 14);
    EXPECT_EQ(metadata->spp, 14);
    EXPECT_EQ(metadata->error, read_snapshot_metadata(read_layers(folder / "whole.exr")->metadata)->error);

    // And it can be resumed.
    expect_done(with(with(tiny(folder / "longer.exr"), all_layers), {"--spp", "20", "--adaptive", "off"}));
    expect_done(
        with({"render", scene_file("cornell"), "--continue", folder / "merged.exr", "--spp", "20", "-o", folder / "on.exr", "--quiet"},
             all_layers));
    expect_same_channels(folder / "on.exr", folder / "longer.exr");
}

// Of scenes with path guiding, light paths, manifold sampling, path reuse and smooth edges: also the first sample alone, and parts
// that do not begin at powers of two.
TEST(Merge, OfAnyRangesIsTheWholeRenderInEveryBit) {
    struct Case {
        const char* scene;
        Arguments options;
        const char* layers;
    };
    const Case cases[] = {
        {"cornell", {}, "albedo,normal,depth,error,samples,id,bounces=4,groups,film"},
        {"veach-mis", {}, "groups,strategies,film"},
        {"pool", {}, "error,groups,film"},
        {"corridor", {"--reuse", "8"}, "bounces=4,error,film"},
        {"card-and-mug", {"--clamp", "2"}, "groups,bounces=4,film"},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.scene);
        const TemporaryFolder folder;
        const Arguments render = with({"render", scene_file(c.scene), "--size", "32x24", "--quiet", "--layers", c.layers}, c.options);
        expect_done(with(render, {"--spp", "11", "--adaptive", "off", "-o", folder / "whole.exr"}));
        merge_ranges(folder, render, {{1, 2}, {2, 7}, {0, 1}, {7, 11}}, folder / "a.exr");
        expect_same_channels(folder / "a.exr", folder / "whole.exr");
    }
}

// Many machines: a pilot in two parts, its allocation, and further parts by that; the image is that of one adaptive render.
TEST(Merge, OfPartsByAnAllocationIsTheAdaptiveRender) {
    const TemporaryFolder folder;
    const Arguments render{"render",   scene_file("veach-mis"),    "--size", "64x48", "--quiet", "--adaptive", "on",
                           "--layers", "samples,error,film,groups"};
    expect_done(with(render, {"--spp", "40", "-o", folder / "whole.exr"}));
    const auto part = [&](const std::string& range, const Arguments& more = {}) {
        expect_done(with(with(render, {"--samples", range, "-o", folder / (range + ".exr")}), more));
        return folder / (range + ".exr");
    };
    const std::string a = part("0:8"), b = part("8:13"), c = part("13:16"), allocation = folder / "allocation.json";
    expect_done({"merge", a, c, b, "-o", folder / "pilot.exr", "--allocation", allocation, "--quiet"});
    const std::string d = part("16:21", {"--allocation", allocation}), e = part("21:40", {"--allocation", allocation});
    expect_done({"merge", e, b, d, a, c, "-o", folder / "merged.exr", "--quiet"});
    expect_same_channels(folder / "merged.exr", folder / "whole.exr");
    // Not uniform: else this would prove nothing.
    const std::vector<float> samples = read_layers(folder / "merged.exr")->find("samples.Y")->values;
    EXPECT_LT(*std::ranges::min_element(samples), 36);
    EXPECT_GT(*std::ranges::max_element(samples), 48);
    // And the pilot continues as one render.
    expect_done({"render", scene_file("veach-mis"), "--continue", folder / "pilot.exr", "--spp", "40", "-o", folder / "on.exr", "--quiet",
                 "--layers", "samples,error,film,groups"});
    expect_same_channels(folder / "on.exr", folder / "whole.exr");

    const auto fails = [&](const Arguments& arguments, int code, const std::string& why) {
        const Finished finished = blush(arguments);
        EXPECT_EQ(finished.exit_code, code) << finished.err;
        EXPECT_NE(finished.err.find(why), std::string::npos) << finished.err;
    };
    const Arguments out{"-o", folder / "out.exr"};
    fails(with(with(render, out), {"--samples", "16:20"}), 2, "--allocation");
    fails(with(with(render, out), {"--samples", "4:12"}), 2, "--allocation");
    fails(with({"render", scene_file("cornell"), "--size", "64x48", "--adaptive", "on", "--samples", "16:20", "--allocation", allocation},
               out),
          1, "another scene");
    fails({"render", scene_file("veach-mis"), "--size", "32x24", "--adaptive", "on", "--samples", "16:20", "--allocation", allocation, "-o",
           folder / "out.exr"},
          1, "64x48");
    fails(with({"merge", a, b, "--allocation", folder / "none.json"}, out), 1, "no allocation");
    std::string text;
    std::getline(std::ifstream(allocation), text);
    text.replace(text.find("\"width\":64") + 8, 2, "65");
    std::ofstream(folder / "damaged.json") << text;
    fails(with(with(render, out), {"--samples", "16:20", "--allocation", folder / "damaged.json"}), 1, "damaged");
}

// Changes one bit of a sum, or the header, of a part.
TEST(Merge, RefusesDamagedPartsAndOtherVersions) {
    const TemporaryFolder folder;
    const Arguments film{"--layers", "film"};
    expect_done(with(with(tiny(folder / "a.exr"), film), {"--samples", "0:2"}));
    expect_done(with(with(tiny(folder / "b.exr"), film), {"--samples", "2:4"}));
    const auto fails = [&](const auto& change, const std::string& why) {
        LayeredImage image = *read_layers(folder / "b.exr");
        change(image);
        ASSERT_TRUE(write_exr(folder / "changed.exr", image));
        const Finished finished = blush({"merge", folder / "a.exr", folder / "changed.exr", "-o", folder / "out.exr"});
        EXPECT_EQ(finished.exit_code, 1) << why;
        EXPECT_NE(finished.err.find("changed.exr"), std::string::npos) << finished.err;
        EXPECT_NE(finished.err.find(why), std::string::npos) << finished.err;
        EXPECT_TRUE(test::is_one_line(finished.err)) << finished.err;
    };
    fails(
        [](LayeredImage& image) {
            LayeredImage::Channel channel = *image.find("film.odd.G.low_bin.low");
            channel.words[77] ^= 1u << 13;
            image.set(channel);
        },
        "checksum");
    fails([](LayeredImage& image) { image.metadata["blush:version"] = "0.1.9"; }, "version of Blush, 0.1.9");
    const std::filesystem::path truncated = folder / "changed.exr";
    std::filesystem::copy_file(folder / "b.exr", truncated, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(truncated, std::filesystem::file_size(truncated) * 3 / 4);
    const Finished finished = blush({"merge", folder / "a.exr", truncated, "-o", folder / "out.exr"});
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_NE(finished.err.find("changed.exr"), std::string::npos) << finished.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out.exr"));
}

// One part at a time: 24 parts take the memory of four.
TEST(Merge, TakesTheMemoryOfAFewParts) {
    const TemporaryFolder folder;
    const Arguments render{"render", scene_file("furnace"), "--size", "400x300", "--quiet", "--layers", "film"};
    const auto peak = [&](int parts) {
        Arguments merge{"merge", "-o", folder / "merged.exr"};
        for (int k = 0; k < parts; ++k) {
            const std::string file = folder / (std::to_string(k) + ".exr");
            if (!std::filesystem::exists(file))
                expect_done(with(render, {"--samples", std::to_string(k) + ":" + std::to_string(k + 1), "-o", file}));
            merge.push_back(file);
        }
        return test::blush_json(merge)["peak_memory_mb"].get<double>();
    };
    const double few = peak(4), many = peak(24);
    EXPECT_GT(few, 400 * 300 * 112 * 1e-6) << "the film alone";
    EXPECT_LT(many, 1.1 * few);
}

} // namespace
} // namespace blush::TEST_FILE
