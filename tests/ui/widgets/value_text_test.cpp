// Formatting and parsing of values: round trips, and rejected text.
#include "ui/widgets/value_text.h"

#include <gtest/gtest.h>
#include <utility>

namespace blush::TEST_FILE {
namespace {

TEST(ValueText, NumbersRoundTrip) {
    for (const float value : {0.f, -0.f, 1.f, -0.1f, 1e-20f, 3.4e38f, 0.333333343f}) {
        const auto read = pasted_number(number_text(value));
        ASSERT_TRUE(read);
        EXPECT_EQ(float(*read), value);
    }
    EXPECT_EQ(number_text(-0.0), "0");
}

TEST(ValueText, AcceptsUnitsBlanksAndCommas) {
    EXPECT_EQ(pasted_number(" 2.5 m\n", "m"), 2.5);
    EXPECT_EQ(pasted_number("90°", "°"), 90);
    EXPECT_EQ(pasted_number("+1,5"), 1.5);
    EXPECT_FALSE(pasted_number("2.5 m"));
    EXPECT_FALSE(pasted_number("1,000,000"));
    EXPECT_FALSE(pasted_number("0x10"));
    EXPECT_FALSE(pasted_number(std::string(200, '1')));
}

TEST(ValueText, LargeNumbersAreWhole) {
    const std::pair<double, const char*> shown[] = {{0.25, "0.25"},     {1234.4, "1234"},     {9999.7, "10000"},  {100000, "100000"},
                                                    {-20000, "-20000"}, {251327.4, "251327"}, {1.5e7, "1.5e+07"}, {1e-5, "1e-05"}};
    for (const auto& [value, text] : shown) EXPECT_EQ(shown_number(value), text);
}

TEST(ValueText, FractionsRoundTrip) {
    EXPECT_EQ(fraction_text(1 / 125.), "1/125");
    EXPECT_EQ(fraction_text(0.3), "1/3.333");
    EXPECT_EQ(fraction_text(1), "1");
    EXPECT_EQ(fraction_text(2.5), "2.5");
    EXPECT_EQ(pasted_number("1/125"), 1 / 125.);
    EXPECT_EQ(pasted_number(" 1 / 8000 s", "s"), 1 / 8000.);
    for (const char* text : {"/", "1/", "/125", "1/0", "0/0", "1/2/3", "1/x"}) EXPECT_FALSE(pasted_number(text)) << text;
}

TEST(ValueText, AcceptsTriplesInBrackets) {
    const Vec3 wanted{1, -2.5f, 0.25f};
    for (const char* text : {"1, -2.5, 0.25", "[1.0, -2.5, .25]", "(1 -2.5 0.25)", "1;-2.5;0.25", "{1,\t-2.5,\n0.25}"})
        EXPECT_EQ(pasted_triple(text), wanted) << text;
    for (const char* text : {"1, 2", "1, 2, 3,", ",1, 2, 3", "1,, 2, 3", "1 2 3 4", "[1, 2, 3", "a, b, c", "1e300, 0, 0"})
        EXPECT_FALSE(pasted_triple(text)) << text;
}

TEST(ValueText, ColoursRoundTripInEachFormat) {
    const Vec3 color{0.8f, 0.1f, 0.02f};
    EXPECT_EQ(pasted_color(triple_text(color)), color);
    const auto encoded = pasted_color(srgb_text(color));
    ASSERT_TRUE(encoded);
    EXPECT_NEAR(encoded->x, color.x, 1e-6);
    EXPECT_NEAR(encoded->z, color.z, 1e-6);
    EXPECT_EQ(hex_text({1, 0, 0.2158605f}), "#ff0080");
    EXPECT_EQ(hex_text({70, -3, 0}), "#ff0000") << "clamped";
    EXPECT_EQ(pasted_color("#F08"), pasted_color("#ff0088"));
    EXPECT_EQ(pasted_color("rgb(255, 0, 136)"), pasted_color("#ff0088"));
    for (const auto text : {"#", "#1234567", "#-1-1-1", "rgb(300", "srgb 1", "-1 0 0"}) EXPECT_FALSE(pasted_color(text)) << text;
}

TEST(ValueText, MessagesAreSanitised) {
    EXPECT_EQ(shown_of("a\nb\x1b[31m"), "a?b?[31m");
    EXPECT_LT(shown_of(std::string(5000, 'x')).size(), 40u);
}

} // namespace
} // namespace blush::TEST_FILE
