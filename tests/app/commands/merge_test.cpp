// `blush merge` and `blush render --continue`: partial renders combine to the samples of one render.
#include "io/image/snapshot.h"
#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
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
Arguments tiny(const std::string& output) { return {"render", scene_file("cornell"), "-o", output, "--size", "24x16", "--quiet"}; }
const Arguments all_layers{"--layers", "albedo,normal,depth,error,samples,id,bounces=3,film"};

void expect_done(const Arguments& arguments) {
    const Finished finished = blush(arguments);
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
}

// Every channel has the same bits.
void expect_same_channels(const std::string& file, const std::string& expected_file) {
    const Result<LayeredImage> image = read_layers(file), expected = read_layers(expected_file);
    ASSERT_TRUE(image && expected);
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
    merge_ranges(folder, with(tiny(folder / "unused.exr"), all_layers), {{5, 12}, {0, 5}, {12, 14}}, folder / "merged.exr");
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
        {"wine-glass", {}, "albedo,normal,bounces=4,film"},
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
        merge_ranges(folder, render, {{8, 11}, {0, 8}}, folder / "b.exr");
        expect_same_channels(folder / "a.exr", folder / "whole.exr");
        expect_same_channels(folder / "b.exr", folder / "whole.exr");
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

// 200 partitions of one image, in random order.
TEST(Merge, DoesNotDependOnThePartition) {
    const TemporaryFolder folder;
    const Arguments render{"render", scene_file("cornell"), "--size", "8x6", "--quiet", "--layers", "film,albedo"};
    constexpr int samples = 12;
    expect_done(with(render, {"--spp", std::to_string(samples), "--adaptive", "off", "-o", folder / "whole.exr"}));
    std::mt19937 random(20);
    for (int k = 0; k < 200; ++k) {
        std::vector<std::pair<int, int>> ranges;
        for (int first = 0; first < samples;) {
            int last = std::min(samples, first + 1 + int(random() % 6));
            if (first == 0) last = std::min(last, samples - 1);
            ranges.emplace_back(first, last);
            first = last;
        }
        std::ranges::shuffle(ranges, random);
        merge_ranges(folder, render, ranges, folder / "merged.exr");
        expect_same_channels(folder / "merged.exr", folder / "whole.exr");
        if (testing::Test::HasFailure()) return;
    }
}

// The sums do not depend on the light mix; the image does.
TEST(Merge, OfFilmStatesAppliesTheLightMix) {
    const TemporaryFolder folder;
    const nlohmann::json channel{{"group", "light 2"}, {"intensity", 3}, {"color", {1, 0.5, 0.25}}};
    const std::string scene = test::scene_with_mix(folder, "veach-mis", {{"grouping", "by_light"}, {"channels", {channel}}});
    const auto render = [&](const std::string& name, const char* range) {
        expect_done({"render", scene, "-o", folder / name, "--size", "24x16", "--quiet", "--layers", "film,groups", "--samples", range});
    };
    render("whole.exr", "0:6");
    render("a.exr", "0:4");
    render("b.exr", "4:6");
    expect_done({"merge", "--quiet", "-o", folder / "merged.exr", folder / "a.exr", folder / "b.exr"});
    expect_same_channels(folder / "merged.exr", folder / "whole.exr");
}

TEST(Merge, OfMeansWeighsThemByTheirSamples) {
    const TemporaryFolder folder;
    const Arguments layers{"--layers", "depth,samples,error"};
    expect_done(with(with(tiny(folder / "whole.exr"), layers), {"--samples", "0:12"}));
    expect_done(with(with(tiny(folder / "a.exr"), layers), {"--samples", "0:9"}));
    expect_done(with(with(tiny(folder / "b.exr"), layers), {"--samples", "9:12"}));
    const nlohmann::json json = test::blush_json({"merge", folder / "a.exr", folder / "b.exr", "-o", folder / "merged.exr"});
    EXPECT_EQ(json["from"], "means");
    EXPECT_EQ(json["spp"], 12);
    const LayeredImage merged = *read_layers(folder / "merged.exr"), whole = *read_layers(folder / "whole.exr"),
                       a = *read_layers(folder / "a.exr"), b = *read_layers(folder / "b.exr");
    for (size_t i = 0; i < 24 * 16; ++i) {
        // Three roundings to single precision instead of one.
        EXPECT_NEAR(merged.find("G")->values[i], whole.find("G")->values[i], 3e-7 * whole.find("G")->values[i]);
        const double ea = 9.0 * a.find("error.R")->values[i], eb = 3.0 * b.find("error.R")->values[i];
        EXPECT_FLOAT_EQ(merged.find("error.R")->values[i], float(std::hypot(ea, eb) / 12));
        EXPECT_EQ(merged.find("samples.Y")->values[i], 12);
        EXPECT_EQ(merged.find("depth.Z")->values[i], a.find("depth.Z")->values[i]);
    }
}

TEST(Merge, RefusesImagesOfDifferentRenders) {
    const TemporaryFolder folder;
    const auto render = [&](const std::string& name, const Arguments& more) { expect_done(with(tiny(folder / name), more)); };
    render("a.exr", {"--samples", "0:2"});
    render("gap.exr", {"--samples", "3:4"});
    render("overlap.exr", {"--samples", "1:3"});
    render("seed.exr", {"--samples", "2:4", "--seed", "1"});
    render("sky.exr", {"--samples", "2:4", "--env", "constant=1,1,1"});
    render("adaptive.exr", {"--spp", "2", "--adaptive", "on"});
    const std::pair<const char*, const char*> wrong[] = {
        {"gap.exr", "missing"},
        {"overlap.exr", "contains sample 1"},
        {"seed.exr", "other settings"},
        {"sky.exr", "another scene"},
        {"adaptive.exr", "cannot be merged from their means"},
        {"nowhere.exr", "nowhere.exr"},
    };
    for (const auto& [name, why] : wrong) {
        const Finished finished = blush({"merge", folder / "a.exr", folder / name, "-o", folder / "out.exr"});
        EXPECT_EQ(finished.exit_code, 1) << name;
        EXPECT_NE(finished.err.find(why), std::string::npos) << name << ": " << finished.err;
        EXPECT_TRUE(test::is_one_line(finished.err)) << finished.err;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "out.exr"));
    EXPECT_EQ(blush({"merge", folder / "a.exr", "-o", folder / "out.exr"}).exit_code, 2);
    EXPECT_EQ(blush({"merge", folder / "a.exr", folder / "gap.exr", "-o", folder / "out.png"}).exit_code, 2);
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
            LayeredImage::Channel channel = *image.find("film.odd.G.fraction.low");
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

// One part at a time: forty parts take the memory of four.
TEST(Merge, TakesTheMemoryOfAFewParts) {
    const TemporaryFolder folder;
    const Arguments render{"render", scene_file("furnace"), "--size", "640x480", "--quiet", "--layers", "film"};
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
    const double few = peak(4), many = peak(40);
    EXPECT_GT(few, 640 * 480 * 112 * 1e-6) << "the film alone";
    EXPECT_LT(many, 1.1 * few);
}

} // namespace
} // namespace blush::TEST_FILE
