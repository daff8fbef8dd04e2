// The estimated error of an image in words: what is known, or why nothing is.
#include "app/commands/error_text.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

constexpr ErrorEstimate both{true, 0.0123, 0.0118, 0.0129, true, 0.2, 0.15, 0.25, false};

TEST(ErrorText, HasWhatIsKnownWithItsInterval) {
    EXPECT_EQ(error_text(both, 2), "estimated relMSE 0.012 (0.012 to 0.013), RMSE 0.2 (0.15 to 0.25)");
    ErrorEstimate one = both;
    one.known = false;
    EXPECT_EQ(error_text(one, 3), "estimated RMSE 0.2 (0.15 to 0.25)");
    one.misses_highlights = true;
    EXPECT_EQ(error_text(one, 3),
              "estimated RMSE 0.2 (0.15 to 0.25); small highlights of lamps may be missing, which the intervals allow for");
}

TEST(ErrorText, SaysWhyNothingIsKnown) {
    EXPECT_EQ(error_text({}, 2), "error not known: too few samples or pixels");
    ErrorEstimate missing;
    missing.misses_highlights = true;
    EXPECT_EQ(error_text(missing, 2), "error not known: small highlights of lamps may be missing");
}

} // namespace
} // namespace blush::TEST_FILE
