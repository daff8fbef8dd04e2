#include "tests/app/program.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

using test::blush_json;
using test::Finished;
using Json = nlohmann::json;

TEST(CheckCommand, JsonHasTheKeysOfTheContract) {
    const Json json = blush_json({"check", "--group", "mirrors"});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json["failed"], 0);
    EXPECT_EQ(json["passed"], json["cases"].size());
    ASSERT_GE(json["cases"].size(), 2u);
    for (const Json& c : json["cases"]) {
        for (const char* key : {"name", "group", "expected", "measured", "sigma", "tolerance", "pass", "seconds"})
            EXPECT_TRUE(c.contains(key)) << key;
        EXPECT_EQ(c["group"], "mirrors");
        EXPECT_EQ(c["pass"], true);
    }
}

TEST(CheckCommand, PrintsATableAndListsKnownLimits) {
    const Finished mirrors = test::blush({"check", "--group", "mirrors", "--quiet"});
    EXPECT_EQ(mirrors.exit_code, 0);
    EXPECT_EQ(mirrors.out, "") << "quiet";
    const Finished limits = test::blush({"check", "--group", "limits"});
    EXPECT_EQ(limits.exit_code, 0) << "limits are not failures";
    EXPECT_NE(limits.out.find("known limits"), std::string::npos);
    EXPECT_NE(limits.out.find("measured"), std::string::npos);
}

TEST(CheckCommand, ListsWithoutRunning) {
    const Finished list = test::blush({"check", "--list"});
    EXPECT_EQ(list.exit_code, 0);
    for (const char* word : {"furnace", "limits", "guards against", "total internal reflection"})
        EXPECT_NE(list.out.find(word), std::string::npos) << word;
}

TEST(CheckCommand, UnknownGroupIsAUsageError) {
    const Finished finished = test::blush({"check", "--group", "no such group"});
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_TRUE(test::is_one_line(finished.err)) << finished.err;
}

} // namespace
} // namespace blush::TEST_FILE
