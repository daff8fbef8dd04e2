// Looks of a plan: combinations, looks.json, names, the turntable.
#include "app/commands/plan/looks.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <set>

namespace blush::TEST_FILE {
namespace {

using test::TemporaryFolder;

Result<std::vector<Axis>> read_text(const std::string& json) {
    const TemporaryFolder folder;
    const std::string file = folder / "looks.json";
    std::ofstream(file) << json;
    return read_looks(file);
}

TEST(PlanLooks, AreAllCombinations) {
    const Axis lights{{.label = "studio", .words = {{"light", "studio"}}}, {.label = "sky", .words = {{"light", "sky"}}}};
    const Axis seeds{{.label = "1", .words = {{"seed", "1"}}}, {.label = "2", .words = {{"seed", "2"}, {"light", "none"}}}};
    const auto looks = combinations("mug", {{"size", "64x36"}, {"seed", "9"}}, {lights, seeds, *frame_axis("3:7:2", 10, {})});
    ASSERT_TRUE(looks);
    ASSERT_EQ(looks->size(), 2u * 2 * 3);
    std::set<std::string> names;
    for (const LookRequest& look : *looks) names.insert(look.name);
    EXPECT_EQ(names.size(), looks->size());
    const LookRequest& last = looks->back();
    EXPECT_EQ(last.name, "mug-sky-2.0007");
    EXPECT_EQ(last.sequence, "mug-sky-2");
    EXPECT_EQ(last.words, (Words{{"size", "64x36"}, {"seed", "2"}, {"light", "none"}, {"animation", "0"}, {"animation-time", "0.7"}}));
}

TEST(PlanLooks, AreLimited) {
    const Axis many(1000);
    EXPECT_FALSE(combinations("a", {}, {many, many}));
    EXPECT_FALSE(combinations("a", {}, {many, many, many, many, many, many, many, many}));
    EXPECT_TRUE(combinations("a", {}, {many, Axis(100)}));
    EXPECT_FALSE(frame_axis("0:9223372036854775807", 24, {}));
    EXPECT_EQ(frame_axis("9223372036854775800:9223372036854775807:5", 24, {})->size(), 2u);
    for (const char* bad : {"", "5", "5:4", "-1:3", "0:4:0", "0:4:1:1", "a:b", "0:4:"}) EXPECT_FALSE(frame_axis(bad, 24, {})) << bad;
}

TEST(PlanLooks, OfAFileAreOverridesAndAMatrix) {
    const auto axes = read_text(R"({"looks": [{"name": "plain"}, {"name": "deep", "set": {"max-bounces": 3, "mis-compensation": false}}],
                                    "matrix": {"light": ["studio", "sky", "none"], "seed": [1, 2]}})");
    ASSERT_TRUE(axes) << axes.error().text();
    ASSERT_EQ(axes->size(), 3u);
    EXPECT_EQ((*axes)[0][1].label, "deep");
    EXPECT_EQ((*axes)[0][1].words, (Words{{"max-bounces", "3"}, {"mis-compensation", "off"}}));
    EXPECT_EQ((*axes)[1].size() * (*axes)[2].size(), 6u);
}

TEST(PlanLooks, ErrorsSayWhere) {
    const std::pair<const char*, const char*> wrong[] = {
        {"[1]", "not a JSON object"},
        {R"({"look": []})", "look"},
        {R"({"looks": {}})", "looks"},
        {R"({"looks": []})", "looks"},
        {R"({"looks": [{"set": {"colour": "red"}}]})", "looks[0].set.colour"},
        {R"({"looks": [{}, {"set": {"size": "big"}}]})", "looks[1].set.size"},
        {R"({"looks": [{"set": {"spp": 4}}]})", "looks[0].set.spp"},
        {R"({"looks": [{"set": {"seed": [1]}}]})", "looks[0].set.seed"},
        {R"({"looks": [{"name": 4}]})", "looks[0].name"},
        {R"({"looks": [{"edits": "x"}]})", "looks[0].edits"},
        {R"({"matrix": {"light": "studio"}})", "matrix.light"},
        {R"({"matrix": {"light": ["moon"]}})", "matrix.light[0]"},
        {R"({"matrix": {"adaptive": ["on"]}})", "matrix.adaptive[0]"},
    };
    for (const auto& [json, where] : wrong) {
        const auto axes = read_text(json);
        ASSERT_FALSE(axes) << json;
        EXPECT_NE(axes.error().text().find(where), std::string::npos) << axes.error().text();
        EXPECT_NE(axes.error().text().find("looks.json"), std::string::npos) << axes.error().text();
    }
}

// Any bytes give a result or an error.
TEST(PlanLooks, OfHostileFilesAreErrors) {
    const std::string good =
        R"({"looks": [{"name": "a", "set": {"seed": 1, "env": "constant=1,2,3"}}], "matrix": {"clamp": ["off", "10,all"]}})";
    ASSERT_TRUE(read_text(good));
    std::mt19937 random(5);
    for (int i = 0; i < 300; ++i) {
        std::string text = good;
        for (int k = 0; k < 3; ++k) text[random() % text.size()] = "{}[]\",:0e-\xff\\n"[random() % 14];
        (void)read_text(text.substr(0, i % 3 ? text.size() : random() % text.size()));
    }
    EXPECT_FALSE(read_text(std::string(100000, '[')));
    std::string deep = R"({"looks": )" + std::string(100000, '[') + std::string(100000, ']') + "}";
    EXPECT_FALSE(read_text(deep));
}

TEST(PlanLooks, HaveNamesThatAreSafeForFiles) {
    EXPECT_EQ(name_of_look("Red mug / left"), "Red-mug---left");
    EXPECT_EQ(name_of_look("../../etc/passwd"), "look..-..-etc-passwd");
    EXPECT_EQ(name_of_look(""), "look");
    EXPECT_EQ(name_of_look("-o"), "look-o");
    EXPECT_LE(name_of_look(std::string(5000, 'x')).size(), 200u);
}

TEST(PlanLooks, OfATurntableGoAroundTheVertical) {
    View view;
    view.position = {3, 2, 0};
    Bounds scene;
    scene.include({1, 0, -1});
    scene.include({1, 4, 1});
    const View quarter = turned(view, scene, 90), whole = turned(view, scene, 360), same = turned(view, scene, 0);
    // About (1, y, 0), as seen from above against the clock: +x turns to -z.
    EXPECT_NEAR(quarter.position.x, 1, 1e-6);
    EXPECT_EQ(quarter.position.y, 2);
    EXPECT_NEAR(quarter.position.z, -2, 1e-6);
    EXPECT_NEAR(quarter.rotation.y, std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(whole.position.x, 3, 1e-5);
    EXPECT_EQ(same.position, view.position);
    const Axis axis = turntable_axis(4);
    ASSERT_EQ(axis.size(), 4u);
    EXPECT_EQ(*axis[3].turn, 270);
    EXPECT_EQ(axis[3].label, "0003");
}

} // namespace
} // namespace blush::TEST_FILE
