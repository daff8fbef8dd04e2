// `blush denoise` and `blush render --denoise` as a script calls them. The networks are tested elsewhere.
#include "core/srgb.h"
#include "io/image/image_io.h"
#include "io/image/snapshot.h"
#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

namespace blush::TEST_FILE {
namespace {

using test::blush_json;
using test::Finished;
using test::scene_file;
using test::TemporaryFolder;
using Json = nlohmann::json;

// Sets an environment variable for child processes during its lifetime.
class Environment {
public:
    Environment(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
    ~Environment() { unsetenv(name_); }

private:
    const char* name_;
};

constexpr int width = 24, height = 17;
constexpr size_t pixels = size_t(width) * height;

// Noisy grey, optional auxiliary channels, and unrelated channels.
LayeredImage noisy_image(bool guides) {
    LayeredImage image{width, height, {}, {{"artist", "somebody"}}};
    uint32_t state = 1;
    const auto noise = [&] { return float((state = state * 1664525u + 1013904223u) >> 8) / float(1 << 24); };
    const auto add = [&](const char* name, auto value) {
        LayeredImage::Channel channel{name, {}};
        for (size_t i = 0; i < pixels; ++i) channel.values.push_back(value());
        image.channels.push_back(std::move(channel));
    };
    for (const char* name : {"R", "G", "B"}) add(name, [&] { return 0.5f * noise() * 2; });
    add("A", [&] { return noise(); });
    if (guides) {
        for (const char* name : {"albedo.R", "albedo.G", "albedo.B"}) add(name, [] { return 0.6f; });
        for (const char* name : {"normal.X", "normal.Y", "normal.Z"}) add(name, [] { return 0.57735f; });
    }
    add("mask.Y", [&] { return noise(); });
    image.channels.push_back({"id.object", std::vector<float>(pixels, 7), true});
    return image;
}

void write(const std::string& file, const LayeredImage& image) {
    const Result<void> written = write_exr(file, image);
    ASSERT_TRUE(written) << written.error().text();
}

double deviation(const std::vector<float>& values) {
    double sum = 0, squares = 0;
    for (const float v : values) sum += double(v), squares += double(v) * double(v);
    const double n = double(values.size());
    return std::sqrt(std::max(0.0, squares / n - sum / n * sum / n));
}

TEST(DenoiseCommand, AddsALayerAndKeepsEverythingElse) {
    const TemporaryFolder folder;
    const LayeredImage in = noisy_image(true);
    write(folder / "in.exr", in);
    const Json json = blush_json({"denoise", folder / "in.exr", "-o", folder / "out.exr", "--quality", "fast"});
    EXPECT_EQ(test::keys_of(json),
              (std::vector<std::string>{"bias_corrected", "energy_change_percent", "guides", "height", "input", "network",
                                        "not_corrected_because", "output", "precision", "sanitised", "seconds", "tiles", "width"}));
    EXPECT_EQ(json["network"], "rt_hdr_alb_nrm_small");
    EXPECT_EQ(json["guides"], (Json{"albedo", "normal"}));
    EXPECT_EQ(json["bias_corrected"], false);
    EXPECT_EQ(json["not_corrected_because"], "no samples in the file: render it with --layers film");
    EXPECT_EQ(json["sanitised"], 0);
    EXPECT_LT(std::abs(json["energy_change_percent"].get<double>()), 20);
    const Result<LayeredImage> out = read_layers(folder / "out.exr");
    ASSERT_TRUE(out) << out.error().text();
    EXPECT_EQ(out->channels.size(), in.channels.size() + 3);
    for (const LayeredImage::Channel& channel : in.channels) {
        const LayeredImage::Channel* kept = out->find(channel.name);
        ASSERT_TRUE(kept) << channel.name;
        EXPECT_EQ(kept->values, channel.values) << channel.name << ", to the last bit";
        EXPECT_EQ(kept->is_uint, channel.is_uint) << channel.name;
    }
    EXPECT_EQ(out->metadata.at("artist"), "somebody");
    EXPECT_EQ(out->metadata.at("blush:denoised"), "rt_hdr_alb_nrm_small, " + json["precision"].get<std::string>());
    for (const char* name : {"R", "G", "B"}) {
        const LayeredImage::Channel* denoised = out->find(std::string("denoised.") + name);
        ASSERT_TRUE(denoised) << name;
        EXPECT_LT(deviation(denoised->values), 0.3 * deviation(in.find(name)->values)) << name;
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2) << "no other files remain";
}

// The samples of the file have half buffers.
TEST(DenoiseCommand, CorrectsTheBiasAsTheRenderDoes) {
    const TemporaryFolder folder;
    const std::string scene = scene_file("card-and-mug");
    const auto render = [&](const char* file, const char* spp, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"render", scene,   "-o", folder / file, "--size",
                                           "48x32",  "--spp", spp,  "--layers",    "albedo,normal,film"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        ASSERT_EQ(test::blush(arguments).exit_code, 0) << file;
    };
    render("in.exr", "8", {"--denoise", "fast"});
    const Json json = blush_json({"denoise", folder / "in.exr", "-o", folder / "out.exr", "--quality", "fast"});
    EXPECT_EQ(json["bias_corrected"], true);
    EXPECT_EQ(json["not_corrected_because"], "");
    const LayeredImage in = *read_layers(folder / "in.exr");
    const LayeredImage out = *read_layers(folder / "out.exr");
    EXPECT_EQ(in.channels.size(), out.channels.size());
    EXPECT_TRUE(out.metadata.at("blush:denoised").ends_with("bias corrected"));
    for (const char* name : {"denoised.R", "denoised.G", "denoised.B"}) {
        ASSERT_TRUE(in.find(name) && out.find(name)) << name;
        EXPECT_EQ(out.find(name)->values, in.find(name)->values) << name << ", to the last bit";
    }
    const auto why_not = [&](const std::string& file) {
        const Json without = blush_json({"denoise", file, "-o", folder / "without.exr", "--quality", "fast"});
        EXPECT_EQ(without["bias_corrected"], false);
        return without["not_corrected_because"].get<std::string>();
    };
    LayeredImage edited = out;
    const auto red = std::ranges::find(edited.channels, "R", &LayeredImage::Channel::name);
    for (float& v : red->values) v *= 1.01f;
    write(folder / "edited.exr", edited);
    EXPECT_EQ(why_not(folder / "edited.exr"), "the pixels are not those of the samples in the file");
    LayeredImage damaged = out;
    for (LayeredImage::Channel& channel : damaged.channels)
        if (channel.name.starts_with("film.even.R")) std::ranges::fill(channel.words, 1u);
    write(folder / "damaged.exr", damaged);
    EXPECT_FALSE(why_not(folder / "damaged.exr").empty());
    render("one.exr", "1", {});
    EXPECT_EQ(why_not(folder / "one.exr"), "no two halves of samples in the file");
}

TEST(DenoiseCommand, IsIdempotent) {
    const TemporaryFolder folder;
    write(folder / "in.exr", noisy_image(false));
    ASSERT_EQ(test::blush({"denoise", folder / "in.exr", "-o", folder / "once.exr", "--threads", "1"}).exit_code, 0);
    ASSERT_EQ(test::blush({"denoise", folder / "once.exr", "-o", folder / "once.exr"}).exit_code, 0) << "also in place";
    ASSERT_EQ(test::blush({"denoise", folder / "once.exr", "-o", folder / "twice.exr", "--threads", "3"}).exit_code, 0);
    const LayeredImage once = *read_layers(folder / "once.exr"), twice = *read_layers(folder / "twice.exr");
    ASSERT_EQ(once.channels.size(), twice.channels.size()) << "the layer is replaced";
    for (size_t i = 0; i < once.channels.size(); ++i) EXPECT_EQ(once.channels[i].values, twice.channels[i].values) << once.channels[i].name;
}

TEST(DenoiseCommand, QualitiesAndGuidesChooseTheNetwork) {
    const TemporaryFolder folder;
    write(folder / "plain.exr", noisy_image(false));
    write(folder / "guided.exr", noisy_image(true));
    const auto network = [&](const char* file, const char* quality) {
        return blush_json({"denoise", folder / file, "-o", folder / "out.exr", "--quality", quality})["network"].get<std::string>();
    };
    EXPECT_EQ(network("plain.exr", "fast"), "rt_hdr_small");
    EXPECT_EQ(network("plain.exr", "high"), "rt_hdr");
    EXPECT_EQ(network("guided.exr", "high"), "rt_hdr_calb_cnrm");
}

TEST(DenoiseCommand, DisplayImagesAreDenoisedLinearlyAndKeepBrightness) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_display_image(folder / "in.png", width, height, std::vector<float>(pixels * 3, 0.5f)));
    for (const char* name : {"out.png", "out.jpg"}) {
        ASSERT_EQ(test::blush({"denoise", folder / "in.png", "-o", folder / name}).exit_code, 0);
        const Json json = blush_json({"compare", folder / name, folder / "in.png"});
        EXPECT_NEAR(json["mean_a"][1].get<double>(), 128.0 / 255, 0.01) << name;
    }
    ASSERT_EQ(test::blush({"denoise", folder / "in.png", "-o", folder / "out.exr"}).exit_code, 0);
    EXPECT_FLOAT_EQ(read_layers(folder / "out.exr")->find("G")->values[0], linear_from_srgb(128.0f / 255)) << "an EXR is scene-linear";
}

TEST(DenoiseCommand, SceneLinearImagesGoThroughTheViewIntoImages) {
    const TemporaryFolder folder;
    write(folder / "in.exr", noisy_image(true));
    ASSERT_EQ(test::blush({"denoise", folder / "in.exr", "-o", folder / "a.png"}).exit_code, 0);
    ASSERT_EQ(test::blush({"denoise", folder / "in.exr", "-o", folder / "b.png", "--exposure", "2"}).exit_code, 0);
    EXPECT_GT(blush_json({"compare", folder / "b.png", folder / "a.png"})["mae"], 0.1);
    EXPECT_EQ(read_layers(folder / "a.png")->metadata.at("blush:denoised").substr(0, 16), "rt_hdr_calb_cnrm");
}

TEST(DenoiseCommand, NonFinitePixelsAreCountedAndReplaced) {
    const TemporaryFolder folder;
    LayeredImage in = noisy_image(true);
    in.channels[0].values[5] = std::numeric_limits<float>::quiet_NaN();
    in.channels[1].values[6] = std::numeric_limits<float>::infinity();
    in.channels[2].values[6] = -1;
    in.channels[2].values[7] = 1e30f;
    write(folder / "in.exr", in);
    const Json json = blush_json({"denoise", folder / "in.exr", "-o", folder / "out.exr"});
    EXPECT_EQ(json["sanitised"], 3) << "pixels";
    EXPECT_TRUE(json["energy_change_percent"].is_number());
    for (const char* name : {"denoised.R", "denoised.G", "denoised.B"}) {
        const LayeredImage out = *read_layers(folder / "out.exr");
        for (const float v : out.find(name)->values) ASSERT_TRUE(std::isfinite(v) && v >= 0);
    }
}

TEST(DenoiseCommand, ErrorsAreOneLine) {
    const TemporaryFolder folder;
    write(folder / "in.exr", noisy_image(false));
    LayeredImage no_color{2, 2, {{"depth.Z", {1, 2, 3, 4}}}, {}};
    write(folder / "depth.exr", no_color);
    std::ofstream(folder / "text.exr") << "not an image";
    const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
        const Finished finished = test::blush(std::move(arguments));
        EXPECT_EQ(finished.exit_code, 1);
        EXPECT_TRUE(test::is_one_line(finished.err)) << finished.err;
        EXPECT_NE(finished.err.find(why), std::string::npos) << finished.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "out.exr"));
    };
    const std::string out = folder / "out.exr";
    refused({"denoise", folder / "none.exr", "-o", out, "--quiet"}, "none.exr: ");
    refused({"denoise", folder / "text.exr", "-o", out, "--quiet"}, "text.exr: not an image");
    refused({"denoise", folder / "depth.exr", "-o", out, "--quiet"}, "depth.exr: the image has no channels R, G and B");
    refused({"denoise", folder / "in.exr", "-o", folder / "none/out.exr", "--quiet"}, "its folder does not exist");
    const Environment nowhere("BLUSH_WEIGHTS", folder / "nowhere");
    refused({"denoise", folder / "in.exr", "-o", out, "--quiet"}, "nowhere/rt_hdr.tza");
    refused({"render", scene_file("cornell"), "-o", out, "--denoise", "fast", "--quiet"}, "nowhere/rt_hdr_alb_nrm_small.tza");
    EXPECT_EQ(test::blush({"render", scene_file("cornell"), "-o", folder / "raw.exr", "--size", "8x8", "--spp", "1"}).exit_code, 0)
        << "rendering does not need weights";
}

TEST(DenoiseCommand, DamagedWeightsAreDetectedBeforeRendering) {
    const TemporaryFolder folder;
    std::filesystem::copy(std::filesystem::path(BLUSH_BINARY).parent_path() / "weights", folder / "weights");
    std::filesystem::resize_file(folder / "weights/rt_hdr_alb_nrm_small.tza", 5000);
    const Environment damaged("BLUSH_WEIGHTS", folder / "weights");
    // The render would take hours if it started.
    const Finished finished =
        test::blush({"render", scene_file("cornell"), "-o", folder / "out.exr", "--spp", "100000000", "--denoise", "fast", "--quiet"});
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_TRUE(test::is_one_line(finished.err)) << finished.err;
    EXPECT_NE(finished.err.find("rt_hdr_alb_nrm_small.tza: "), std::string::npos) << finished.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out.exr"));
}

TEST(RenderDenoised, AddsALayerAndKeepsTheBeauty) {
    const TemporaryFolder folder;
    const std::vector<std::string> common{"--size", "64x48", "--spp", "4"};
    const auto render = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"render", scene_file("cornell")});
        more.insert(more.end(), common.begin(), common.end());
        return blush_json(std::move(more));
    };
    const Json raw = render({"-o", folder / "raw.exr"});
    EXPECT_FALSE(raw.contains("denoise"));
    const Json json = render({"-o", folder / "out.exr", "--denoise", "high"});
    EXPECT_EQ(test::keys_of(json["denoise"]), (std::vector<std::string>{"bias_corrected", "energy_change_percent", "network", "precision",
                                                                        "sanitised", "seconds", "tiles"}));
    EXPECT_EQ(json["denoise"]["network"], "rt_hdr_calb_cnrm") << "albedo and normal are rendered for it";
    EXPECT_EQ(json["error"], raw["error"]) << "the estimated error is that of the raw image";
    const LayeredImage before = *read_layers(folder / "raw.exr"), after = *read_layers(folder / "out.exr");
    EXPECT_EQ(after.channels.size(), before.channels.size() + 3) << "without the guides, unless --layers asks for them";
    for (const char* name : {"R", "G", "B", "A"}) EXPECT_EQ(after.find(name)->values, before.find(name)->values) << name;
    EXPECT_NE(after.find("denoised.R")->values, before.find("R")->values);
    EXPECT_EQ(read_snapshot_metadata(after.metadata)->denoised.substr(0, 16), "rt_hdr_calb_cnrm");
}

// The network shifts the furnace by a few per cent, its rendered image is exact: there is no noise that could hide the bias.
TEST(RenderDenoised, AnExactImageStaysAsItIs) {
    const TemporaryFolder folder;
    const Json json =
        blush_json({"render", scene_file("furnace"), "-o", folder / "furnace.exr", "--size", "96x54", "--spp", "2", "--denoise", "fast"});
    EXPECT_EQ(json["denoise"]["bias_corrected"], true);
    EXPECT_NEAR(json["denoise"]["energy_change_percent"].get<double>(), 0, 1e-3);
    const LayeredImage image = *read_layers(folder / "furnace.exr");
    const std::vector<float>&raw = image.find("G")->values, &denoised = image.find("denoised.G")->values;
    for (size_t i = 0; i < raw.size(); ++i) ASSERT_NEAR(denoised[i], raw[i], 1e-5f) << i;
}

// Light groups are denoised separately and then mixed, as in the window: the input of the networks does not depend on the mix.
TEST(RenderDenoised, GroupsAreDenoisedBeforeTheyAreMixed) {
    const TemporaryFolder folder;
    // Light 1 only and the others only, with the same samples: the mix is applied after light sampling.
    const auto denoised = [&](const std::string& name, const std::vector<std::string>& off) {
        Json mix{{"grouping", "by_light"}, {"channels", Json::array()}};
        for (const std::string& group : off) mix["channels"].push_back({{"group", group}, {"enabled", false}});
        const std::string scene = test::scene_with_mix(folder, "veach-mis", mix);
        blush_json({"render", scene, "-o", folder / name, "--size", "48x32", "--spp", "4", "--denoise", "fast", "--strategy", "bsdf"});
        return read_layers(folder / name)->find("denoised.G")->values;
    };
    const std::vector<float> all = denoised("all.exr", {}), first = denoised("first.exr", {"light 2", "light 3", "light 4"}),
                             others = denoised("others.exr", {"light 1"});
    ASSERT_EQ(all.size(), 48u * 32u);
    for (size_t i = 0; i < all.size(); ++i) ASSERT_NEAR(all[i], first[i] + others[i], 1e-5f * (1 + all[i]));
}

TEST(RenderDenoised, ImagesShowItAndCompareSeesTheLayer) {
    const TemporaryFolder folder;
    const auto render = [&](const std::string& output, const char* denoise, const char* spp) {
        return test::blush({"render", scene_file("cornell"), "-o", folder / output, "--size", "64x48", "--spp", spp, "--denoise", denoise})
            .exit_code;
    };
    ASSERT_EQ(render("raw.png", "off", "2"), 0);
    ASSERT_EQ(render("fast.png", "fast", "2"), 0);
    ASSERT_EQ(render("fast.exr", "fast", "2"), 0);
    ASSERT_EQ(render("reference.exr", "off", "1024"), 0);
    EXPECT_GT(blush_json({"compare", folder / "fast.png", folder / "raw.png"})["mae"], 0.01);
    const Json raw = blush_json({"compare", folder / "fast.exr", folder / "reference.exr"});
    const Json layer = blush_json({"compare", folder / "fast.exr", folder / "reference.exr", "--layer", "denoised"});
    EXPECT_LT(layer["relmse"].get<double>(), 0.2 * raw["relmse"].get<double>());
    const Finished finished = test::blush({"compare", folder / "fast.exr", folder / "reference.exr", "--layer", "none"});
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_NE(finished.err.find("no layer none.{R,G,B}"), std::string::npos) << finished.err;
}

} // namespace
} // namespace blush::TEST_FILE
