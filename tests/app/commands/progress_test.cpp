#include "app/commands/progress.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

TEST(Progress, DurationsAreReadable) {
    EXPECT_EQ(duration_text(0), "0 s");
    EXPECT_EQ(duration_text(41.2), "42 s");
    EXPECT_EQ(duration_text(59.9), "1 min 00 s");
    EXPECT_EQ(duration_text(185), "3 min 05 s");
    EXPECT_EQ(duration_text(2 * 3600 + 7 * 60), "2 h 07 min");
    EXPECT_EQ(duration_text(-1), "0 s");
}

TEST(Progress, TheBarFills) {
    EXPECT_EQ(progress_bar(0, 0, "", 80), "[--------------------]   0 %");
    EXPECT_EQ(progress_bar(0.5, 10, "32 spp", 80), "[##########----------]  50 %  10 s left  32 spp");
    EXPECT_EQ(progress_bar(1, 10, "64 spp", 80), "[####################] 100 %  64 spp");
}

TEST(Progress, ShowsHundredPercentOnlyAtTheEnd) {
    EXPECT_NE(progress_bar(0.9999, 10, "", 80).find(" 99 %"), std::string::npos);
    EXPECT_EQ(progress_bar(0.9999, 10, "", 80).find("100"), std::string::npos);
}

TEST(Progress, FitsIntoTheTerminal) { EXPECT_EQ(progress_bar(0.5, 10, "a very long note", 30).size(), 30u); }

} // namespace
} // namespace blush::TEST_FILE
