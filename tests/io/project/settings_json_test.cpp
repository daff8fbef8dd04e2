#include "io/project/settings_json.h"
#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

namespace blush::test::TEST_FILE {
namespace {

RenderSettings unusual_settings() {
    RenderSettings s;
    s.width = 640;
    s.height = 360;
    s.resolution_scale = 0.5f;
    s.spp = 0;
    s.seconds = 12.5;
    s.error = 0.001;
    s.first_sample = 32;
    s.seed = 4294967295u;
    s.max_bounces = 2;
    s.roulette = {Roulette::Rule::constant, 1, 0.05f, 0.95f, 0.7f, 0.1f};
    s.strategy = Strategy::bsdf;
    s.heuristic = {MisHeuristic::Rule::cutoff, 2, 0.25f};
    s.caustics = CausticStrategy::light_paths;
    s.filter = PixelFilter::box;
    s.sampler = SamplerType::random;
    s.energy_compensation = true;
    s.mis_compensation = true;
    s.reuse = 8;
    s.smooth_edges = true;
    s.clamp = {2.5f, true};
    s.region = {0.25f, 0.125f, 0.5f, 0.375f};
    return s;
}

TEST(SettingsJson, RenderSettingsRoundTrip) {
    RenderSettings adaptive;
    adaptive.adaptive = true;
    for (const RenderSettings& s : {RenderSettings{}, unusual_settings(), adaptive}) {
        const auto parsed = parse_render_settings(render_settings_json(s));
        ASSERT_TRUE(parsed) << error_text(parsed);
        EXPECT_EQ(parsed->settings, s);
        EXPECT_TRUE(parsed->diagnostics.empty());
    }
}

TEST(SettingsJson, ViewSettingsRoundTrip) {
    ViewSettings unusual{-1.5f, 2.2f, "sRGB", "ACES SDR", "High contrast", AutoExposure::highlights, {1, 0.7f, 0.4f}};
    unusual.false_color = {FalseColor::Of::lux, 10, 20000};
    unusual.background_as_it_is = true;
    unusual.meters = {{"Desk", {7}, {1, 2, 3}, {0, 0, 1}, 0.001f}, {"\"Floor\"", {}, {-1, 0, 5}, {0, 1, 0}, 0}};
    unusual.measured = {0.25f, 0.5f, 0.125f, 0.25f};
    unusual.frame_aspect = 2.39f;
    unusual.lock_camera = true;
    for (const ViewSettings& s : {ViewSettings{}, unusual}) {
        const auto parsed = parse_view_settings(view_settings_json(s));
        ASSERT_TRUE(parsed) << error_text(parsed);
        EXPECT_EQ(parsed->settings, s);
        EXPECT_TRUE(parsed->diagnostics.empty());
    }
}

TEST(SettingsJson, PartialInputKeepsTheRestAndUnknownKeysAreReported) {
    RenderSettings expected = unusual_settings();
    expected.max_bounces = 5;
    const auto parsed = parse_render_settings(R"({"max_bounces": 5, "colour": "red"})", unusual_settings());
    ASSERT_TRUE(parsed) << error_text(parsed);
    EXPECT_EQ(parsed->settings, expected);
    ASSERT_EQ(parsed->diagnostics.size(), 1u);
    EXPECT_EQ(parsed->diagnostics[0].where, "colour");
}

TEST(SettingsJson, WrongInputIsAnErrorThatNamesTheKey) {
    for (const auto& [text, where] :
         std::vector<std::pair<std::string, std::string>>{{R"({"size": "0x10"})", ""},
                                                          {R"({"size": "10"})", "size"},
                                                          {R"({"size": "10x10x"})", "size"},
                                                          {R"({"spp": "many"})", "spp"},
                                                          {R"({"spp": -1})", ""},
                                                          {R"({"spp": 18446744073709551615})", "spp"},
                                                          {R"({"seed": -1})", "seed"},
                                                          {R"({"seed": 4294967296})", "seed"},
                                                          {R"({"time": 1e999})", ""},
                                                          {R"({"resolution_scale": 1e300})", "resolution_scale"},
                                                          {R"({"max_bounces": -5})", "max_bounces"},
                                                          {R"({"max_bounces": "few"})", "max_bounces"},
                                                          {R"({"roulette": "russian"})", "roulette"},
                                                          {R"({"strategy": 3})", "strategy"},
                                                          {R"({"heuristic": "power=9"})", "heuristic"},
                                                          {R"({"sampler": "halton"})", "sampler"},
                                                          {R"({"energy_compensation": "yes"})", "energy_compensation"},
                                                          {R"({"reuse": "5"})", "reuse"},
                                                          {R"({"clamp": 3})", "clamp"},
                                                          {"[]", ""},
                                                          {"", ""},
                                                          {"{", ""}}) {
        const auto parsed = parse_render_settings(text);
        ASSERT_FALSE(parsed) << text;
        if (!where.empty()) { EXPECT_EQ(parsed.error().where, where) << text; }
    }
    for (const char* text :
         {R"({"gamma": 0})", R"({"white": [1, 1]})", R"({"white": [0, 0, 0]})", R"({"white": [1, -1, 1]})", R"({"white": 1})",
          R"({"auto_exposure": "on"})", R"({"false_color": "nits=5:1"})", R"({"false_color": "stops=1:2"})",
          R"({"measured": [0.5, 0.5, 0.6, 0.1]})", R"({"measured": [0, 0, 0, 1]})", R"({"measured": [0, 0, 1]})", R"({"meters": {}})",
          R"({"meters": [3]})", R"({"meters": [{"name": "", "node": 0, "position": [0, 0, 0], "normal": [0, 0, 0], "clearance": 0}]})",
          R"({"meters": [{"name": "", "node": -1, "position": [0, 0, 0], "normal": [0, 1, 0], "clearance": 0}]})"})
        EXPECT_FALSE(parse_view_settings(text)) << text;
    EXPECT_FALSE(parse_render_settings(std::string(1000000, '[')));
}

} // namespace
} // namespace blush::test::TEST_FILE
