#include "app/commands/render/layers.h"
#include "app/commands/render/render_options.h"

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

RenderOptions parsed(std::vector<std::string> arguments) {
    CLI::App app;
    RenderOptions options;
    add_render_options(app, options);
    std::ranges::reverse(arguments); // CLI11 expects a reversed vector
    app.parse(arguments);
    return options;
}

bool refused(const std::vector<std::string>& arguments) {
    try {
        parsed(arguments);
    } catch (const CLI::ParseError&) { return true; }
    return false;
}

TEST(RenderOptions, NoOptionsGiveTheDefaults) {
    const RenderOptions options = parsed({});
    EXPECT_EQ(*settings_of(options), recommended_settings());
    EXPECT_EQ(options.view, ViewSettings{});
    EXPECT_FALSE(options.size_given);
    EXPECT_FALSE(options.overrides.environment);
    EXPECT_FALSE(options.overrides.texture_mib);
}

TEST(RenderOptions, TextureMemoryIsInMebibytes) {
    EXPECT_EQ(parsed({"--texture-memory", "64"}).overrides.texture_mib, 64);
    EXPECT_TRUE(refused({"--texture-memory", "0"}));
}

std::vector<std::string> every_option() {
    return {"--size",
            "320x200",
            "--spp",
            "12",
            "--time",
            "2.5",
            "--error",
            "0.01",
            "--seed",
            "7",
            "--max-bounces",
            "2",
            "--roulette",
            "constant=0.5,start=1",
            "--strategy",
            "light",
            "--caustics",
            "manifold",
            "--energy-compensation",
            "on",
            "--heuristic",
            "cutoff=0.25",
            "--mis-compensation",
            "off",
            "--adaptive",
            "off",
            "--reuse",
            "16",
            "--smooth-edges",
            "off",
            "--clamp",
            "4,all",
            "--filter",
            "box",
            "--sampler",
            "random",
            "--exposure",
            "-1.5",
            "--view",
            "Raw",
            "--display",
            "sRGB",
            "--look",
            "High contrast",
            "--auto-exposure",
            "highlights",
            "--white",
            "1,0.8,0.5",
            "--false-color",
            "nits=10:500",
            "--aperture",
            "0.02",
            "--focus",
            "3",
            "--camera",
            "Top"};
}

TEST(RenderOptions, EachOptionSetsItsField) {
    RenderSettings expected = recommended_settings();
    expected.width = 320;
    expected.height = 200;
    expected.spp = 12;
    expected.seconds = 2.5;
    expected.error = 0.01;
    expected.seed = 7;
    expected.max_bounces = 2;
    expected.roulette = {Roulette::Rule::constant, 1, 0, 1, 0.5f, 0.1f};
    expected.strategy = Strategy::light;
    expected.heuristic = {MisHeuristic::Rule::cutoff, 2, 0.25f};
    expected.caustics = CausticStrategy::manifold;
    expected.energy_compensation = true;
    expected.mis_compensation = false;
    expected.adaptive = false;
    expected.reuse = 16;
    expected.smooth_edges = false;
    expected.clamp = {4, true};
    expected.filter = PixelFilter::box;
    expected.sampler = SamplerType::random;
    const RenderOptions options = parsed(every_option());
    EXPECT_EQ(*settings_of(options), expected);
    EXPECT_TRUE(options.size_given);
    EXPECT_EQ(options.view.exposure_ev, -1.5f);
    EXPECT_EQ(options.view.view, "Raw");
    EXPECT_EQ(options.view.display, "sRGB");
    EXPECT_EQ(options.view.look, "High contrast");
    EXPECT_EQ(options.view.auto_exposure, AutoExposure::highlights);
    EXPECT_EQ(options.view.white, (Vec3{1, 0.8f, 0.5f}));
    EXPECT_EQ(options.view.false_color, (FalseColor{FalseColor::Of::nits, 10, 500}));
    EXPECT_EQ(options.overrides.aperture, 0.02f);
    EXPECT_EQ(options.overrides.focus, 3.f);
    EXPECT_EQ(options.overrides.camera, "Top");
}

TEST(RenderOptions, AMissingSideFollowsTheAspect) {
    const auto size_for = [](std::vector<std::string> arguments, float aspect) {
        RenderOptions options = parsed(arguments);
        follow_aspect(options, aspect);
        return std::pair(options.settings.width, options.settings.height);
    };
    EXPECT_EQ(size_for({}, 1), std::pair(1280, 1280));
    EXPECT_EQ(size_for({}, 0), std::pair(1280, 720)) << "unknown";
    EXPECT_EQ(size_for({"--size", "600x"}, 1.5f), std::pair(600, 400));
    EXPECT_EQ(size_for({"--size", "640x"}, 0), std::pair(640, 360));
    EXPECT_EQ(size_for({"--size", "x300"}, 2), std::pair(600, 300));
    EXPECT_EQ(size_for({"--size", "600x300"}, 1), std::pair(600, 300)) << "explicit values take precedence";
    for (const char* wrong : {"x", "", "0x5", "5x0", "600x400x3", "wide", "600", "600xh"})
        EXPECT_ANY_THROW(parsed({"--size", wrong})) << wrong;
}

TEST(RenderOptions, ARegionIsPixelsOfTheImage) {
    const RenderSettings settings = *settings_of(parsed({"--size", "640x480", "--region", "160,120,320,60"}));
    EXPECT_EQ(settings.region, (ImageRegion{0.25f, 0.25f, 0.5f, 0.125f}));
    EXPECT_EQ(pixels_of(settings.region, 640, 480), (PixelRect{160, 120, 480, 180}));
    EXPECT_FALSE(settings_of(parsed({"--size", "640x480", "--region", "600,0,41,10"})));
    EXPECT_FALSE(settings_of(parsed({"--region", "0,0,64,64", "--adaptive", "on"})));
}

TEST(RenderOptions, SamplesAreARange) {
    const RenderSettings settings = *settings_of(parsed({"--samples", "16:48"}));
    EXPECT_EQ(settings.first_sample, 16);
    EXPECT_EQ(settings.spp, 48);
    EXPECT_FALSE(settings_of(parsed({"--samples", "16:48", "--spp", "64"})));
}

TEST(RenderOptions, AdaptiveSamplingTakesRangesOfThePilotOrAnAllocation) {
    EXPECT_TRUE(settings_of(parsed({}))->adaptive);
    EXPECT_FALSE(settings_of(parsed({"--adaptive", "off"}))->adaptive);
    EXPECT_FALSE(settings_of(parsed({"--adaptive", "off", "--samples", "16:48"}))->adaptive);
    EXPECT_FALSE(settings_of(parsed({"--samples", "16:48"}))->adaptive) << "the default is removed";
    for (const char* range : {"16:48", "4:12"}) {
        const Result<RenderSettings> both = settings_of(parsed({"--adaptive", "on", "--samples", range}));
        ASSERT_FALSE(both);
        EXPECT_NE(both.error().text().find("--allocation"), std::string::npos) << both.error().text();
    }
}

TEST(RenderOptions, AnotherLimitRemovesTheDefaultLimit) {
    EXPECT_EQ(settings_of(parsed({"--time", "5"}))->spp, 0);
    EXPECT_EQ(settings_of(parsed({"--error", "0.01"}))->spp, 0);
    EXPECT_EQ(settings_of(parsed({"--time", "5", "--spp", "64"}))->spp, 64);
    EXPECT_EQ(settings_of(parsed({"--time", "5", "--samples", "0:8"}))->spp, 8);
}

TEST(RenderOptions, NumbersOutOfRangeAreRefused) {
    EXPECT_FALSE(settings_of(parsed({"--time", "-1"})));
    EXPECT_FALSE(settings_of(parsed({"--time", "nan"})));
    EXPECT_FALSE(settings_of(parsed({"--size", "70000x1"})));
    EXPECT_FALSE(settings_of(parsed({"--exposure", "1000"})));
}

TEST(RenderOptions, BadTextIsRefused) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--size", "320"},
                                                      {"--size", "320x200x3"},
                                                      {"--size", "axb"},
                                                      {"--spp", "0"},
                                                      {"--spp", "1.5"},
                                                      {"--seed", "-1"},
                                                      {"--max-bounces", "few"},
                                                      {"--strategy", "both"},
                                                      {"--caustics", "on"},
                                                      {"--heuristic", "power=0"},
                                                      {"--sampler", "halton"},
                                                      {"--energy-compensation", "maybe"},
                                                      {"--mis-compensation", "maybe"},
                                                      {"--smooth-edges", "maybe"},
                                                      {"--reuse", "3"},
                                                      {"--filter", "gauss"},
                                                      {"--samples", "8:4"},
                                                      {"--samples", "-1:4"},
                                                      {"--samples", "4"},
                                                      {"--env", "constant=1,2"},
                                                      {"--env", ""},
                                                      {"--denoise", "base"}})
        EXPECT_TRUE(refused(arguments)) << arguments[0] << " " << arguments[1];
}

TEST(RenderOptions, DenoisingIsOffUntilAskedFor) {
    EXPECT_FALSE(parsed({}).denoise);
    EXPECT_FALSE(parsed({"--denoise", "off"}).denoise);
    EXPECT_EQ(parsed({"--denoise", "fast"}).denoise, DenoiseQuality::fast);
    EXPECT_EQ(parsed({"--denoise", "high"}).denoise, DenoiseQuality::high);
}

TEST(Layers, AreParsedByName) {
    EXPECT_EQ(*parse_layers("albedo"), (Layers{.albedo = true}));
    EXPECT_EQ(*parse_layers("albedo,normal,depth,error,samples,id"), (Layers{true, true, true, true, true, true}));
    for (const char* bad : {"", "albedo,", "Albedo", "group", "bounces=1", "bounces=33", "bounces=", "albedo normal"})
        EXPECT_FALSE(parse_layers(bad)) << bad;
}

TEST(Layers, TheFilmHoldsOnlyWhatTheyNeed) {
    EXPECT_EQ(planes_of(*parse_layers("error,samples")), PlaneSet{});
    EXPECT_EQ(planes_of(*parse_layers("bounces")).bounces, 8);
    EXPECT_EQ(planes_of(*parse_layers("bounces=2,id")), (PlaneSet{.ids = true, .bounces = 2}));
    EXPECT_EQ(planes_of(*parse_layers("strategies,depth")), (PlaneSet{.depth = true, .strategies = true}));
    EXPECT_EQ(planes_of(*parse_layers("normal,id")), (PlaneSet{.normal = true, .ids = true}));
}

} // namespace
} // namespace blush::TEST_FILE
