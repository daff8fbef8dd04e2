// `blush bleed`: places, stop rules, JSON and text.
#include "tests/app/program.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

using test::blush;
using test::blush_json;
using test::Finished;
using test::keys_of;
using test::scene_file;

using Arguments = std::vector<std::string>;
using nlohmann::json;

Arguments with(const Arguments& more) {
    Arguments arguments{"bleed", scene_file("card-and-mug"), "--size", "64x36", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

double share_sum(const json& rows) {
    double sum = 0;
    for (const json& row : rows) sum += row["share"]["value"].get<double>();
    return sum;
}

TEST(BleedCommand, MeasuresAPixel) {
    const json j = blush_json(with({"--pixel", "30,23"}));
    EXPECT_EQ(keys_of(j), (Arguments{"complete", "height", "paths", "results", "scene", "seconds", "width"}));
    EXPECT_TRUE(j["complete"]);
    ASSERT_EQ(j["results"].size(), 1u);
    const json& r = j["results"][0];
    EXPECT_LE(r["error"].get<double>(), 0.01);
    EXPECT_EQ(r["unit"], "nits");
    for (const char* list : {"senders", "lights", "bounces"}) EXPECT_NEAR(share_sum(r[list]), 1, 1e-9) << list;
    const auto mug = std::ranges::find_if(r["senders"], [](const json& row) { return row["name"] == "mug body"; });
    ASSERT_NE(mug, r["senders"].end());
    EXPECT_EQ((*mug)["kind"], "object");
    EXPECT_EQ((*mug)["shift"]["towards"], "red");
    EXPECT_GT((*mug)["share"]["low"].get<double>(), 0.05);
    EXPECT_LT((*mug)["share"]["low"].get<double>(), (*mug)["share"]["high"].get<double>());
}

TEST(BleedCommand, MeasuresARectangleAndAPoint) {
    const json rect = blush_json(with({"--rect", "20,15,20,12", "--samples", "5000"}));
    EXPECT_EQ(rect["paths"], 8192); // two rounds
    const json point = blush_json(with({"--point", "0.1,0.02,0.1", "--samples", "1"}));
    ASSERT_EQ(point["results"].size(), 2u);
    EXPECT_EQ(point["results"][0]["unit"], "lx");
    EXPECT_EQ(point["results"][1]["unit"], "nits");
    EXPECT_NEAR(point["results"][0]["place"][1].get<double>(), 0, 0.01); // the table
    const json facing = blush_json(with({"--point", "0,1,0", "--normal", "0,-1,0", "--samples", "1"}));
    EXPECT_EQ(facing["results"][0]["place"], (json{0.0, 1.0, 0.0}));
}

TEST(BleedCommand, DoesNotDependOnThreads) {
    const auto result = [](const char* threads) {
        return blush_json(with({"--pixel", "30,23", "--samples", "4096", "--threads", threads}))["results"];
    };
    EXPECT_EQ(result("1"), result("3"));
}

TEST(BleedCommand, SaysItInPlainWords) {
    const Finished finished = blush({"bleed", scene_file("card-and-mug"), "--size", "64x36", "--pixel", "30,23"});
    EXPECT_EQ(finished.exit_code, 0);
    for (const char* text : {"mug body adds ", "towards red.", "Sent by", "From light", "Scattered", "sun, direct", "Not included"})
        EXPECT_NE(finished.out.find(text), std::string::npos) << text << "\n" << finished.out;
}

TEST(BleedCommand, RefusesBadUsage) {
    for (const Arguments& bad : std::vector<Arguments>{{},
                                                       {"--pixel", "64,0"},
                                                       {"--pixel", "1"},
                                                       {"--pixel", "1,2", "--rect", "0,0,2,2"},
                                                       {"--rect", "60,30,10,2"},
                                                       {"--rect", "1,1,0,4"},
                                                       {"--rect", "2147483647,1,2147483647,4"},
                                                       {"--point", "1,2"},
                                                       {"--point", "1,2,nan"},
                                                       {"--point", "1,2,3", "--normal", "0,0,0"},
                                                       {"--pixel", "1,2", "--normal", "0,1,0"},
                                                       {"--pixel", "1,2", "--error", "0"},
                                                       {"--pixel", "1,2", "--error", "x%"},
                                                       {"--pixel", "1,2", "--error", "1%", "--samples", "9"},
                                                       {"--pixel", "1,2", "--samples", "0"}}) {
        const Finished finished = blush(with(bad));
        EXPECT_EQ(finished.exit_code, 2) << testing::PrintToString(bad);
        EXPECT_TRUE(test::is_one_line(finished.err)) << finished.err;
    }
    const Finished missing = blush({"bleed", "/nonexistent/a.gltf", "--pixel", "1,1", "--quiet"});
    EXPECT_EQ(missing.exit_code, 1);
    EXPECT_TRUE(test::is_one_line(missing.err)) << missing.err;
}

} // namespace
} // namespace blush::TEST_FILE
