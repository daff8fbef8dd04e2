// Convergence tables: round trip, and errors with line numbers for invalid files.
#include "measure/convergence/convergence_csv.h"

#include <gtest/gtest.h>

namespace blush::test::TEST_FILE {
namespace {

using Kind = ConvergencePoint::Kind;

TEST(ConvergenceCsv, RoundTrips) {
    ConvergenceRecord a, b;
    a.name = "a \"fast\", small one\nof two lines";
    a.set({Kind::estimated, 0.5, 2, {true, 0.25, 0.2, 0.3}, {true, 0.5, 0.25, 0.75}});
    a.set({Kind::measured, 0.5, 2, {false, 0.125, 0, 0}, {}});
    a.set({Kind::denoised, 1, 4, {}, {true, 0.0625, 0.03125, 0.125}});
    a.mark({0.75, 3, "Change light sun, \"warm\""});
    a.mark({0.8, 3, "Change light mix", true});
    b.name = "b";
    b.set({Kind::measured, 1, 1, {false, 1, 0, 0}, {false, 2, 0, 0}});
    const std::string csv = to_csv({a, b});
    EXPECT_TRUE(csv.starts_with("name,seconds,spp,relmse,relmse_low,relmse_high,rmse,rmse_low,rmse_high,kind,label\n"));
    EXPECT_NE(csv.find("b,1,1,2,,,1,,,measured,\n"), csv.npos) << csv;
    const auto read = parse_convergence_csv(csv);
    ASSERT_TRUE(read) << read.error().text();
    ASSERT_EQ(read->size(), 2u);
    EXPECT_EQ((*read)[0].name, a.name);
    ASSERT_EQ((*read)[0].points().size(), 3u);
    ASSERT_EQ((*read)[0].marks().size(), 2u);
    EXPECT_EQ((*read)[0].marks()[0].label, "Change light sun, \"warm\"");
    EXPECT_FALSE((*read)[0].marks()[0].other_mix);
    EXPECT_TRUE((*read)[0].marks()[1].other_mix);
    EXPECT_EQ(to_csv(*read), csv);
}

TEST(ConvergenceCsv, ReadsWhatConvergeWrites) {
    const auto read = parse_convergence_csv("\xef\xbb\xbfvariant,seconds,spp,mse,relmse,flip,mean_r,mean_g,mean_b,repeat\r\n"
                                            "\"plain, old\",0.5,4,0.25,0.1,0.05,1,1,1,0\r\n"
                                            "\"plain, old\",1,8,0.0625,0.05,,1,1,1,0\r\n"
                                            "\"plain, old\",0.5,4,0.25,0.1,,1,1,1,1\r\n\r\n");
    ASSERT_TRUE(read) << read.error().text();
    ASSERT_EQ(read->size(), 2u);
    EXPECT_EQ((*read)[0].name, "plain, old");
    EXPECT_EQ((*read)[1].name, "plain, old, repeat 1");
    const auto& points = (*read)[0].points();
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[1].kind, Kind::measured);
    EXPECT_EQ(points[1].rmse.value, 0.25);
    EXPECT_EQ(points[1].relmse.value, 0.05);
    EXPECT_FALSE(points[1].rmse.known);
}

TEST(ConvergenceCsv, RefusesInvalidTables) {
    const std::string header = "name,seconds,spp,rmse,kind\n";
    const auto refused = [](const std::string& text, const char* where) {
        const auto read = parse_convergence_csv(text);
        return !read && read.error().where == where;
    };
    EXPECT_TRUE(refused("", ""));
    EXPECT_TRUE(refused(std::string(100, '\0'), ""));
    EXPECT_TRUE(refused("name,seconds,rmse\na,1,1\n", ""));
    EXPECT_TRUE(refused(header, "")) << "empty";
    EXPECT_TRUE(refused(header + "a,1,1,1,estimated\nb,x,1,1,estimated\n", "line 3"));
    EXPECT_TRUE(refused(header + "a,nan,1,1,estimated\n", "line 2"));
    EXPECT_TRUE(refused(header + "a,1,1,-1,estimated\n", "line 2"));
    EXPECT_TRUE(refused(header + "a,1,1,1e999,estimated\n", "line 2"));
    EXPECT_TRUE(refused(header + "a,1,1e300,1,estimated\n", "line 2"));
    EXPECT_TRUE(refused(header + "a,1,1,1,guessed\n", "line 2"));
    EXPECT_TRUE(refused(header + "\"a,1,1,1,estimated\n", "line 2")) << "an unclosed quote";
    std::string many = header;
    for (int i = 0; i < 65; ++i) many += std::to_string(i) + ",1,1,1,estimated\n";
    EXPECT_TRUE(refused(many, "line 66"));
    std::string longest = header;
    for (int i = 0; i < 20001; ++i) longest += "a,1,1,1,estimated\n";
    EXPECT_TRUE(refused(longest, "line 20001"));
}

} // namespace
} // namespace blush::test::TEST_FILE
