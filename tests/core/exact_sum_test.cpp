// Exact sums: the same bits for any order and grouping, as precise as the unit allows.
#include "core/exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace blush::test {
namespace {

// Radiance from dark corners to the sun's disc, with fireflies.
std::vector<double> samples(int count, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> exponent(-40, 30), mantissa(1, 2);
    std::vector<double> result;
    for (int i = 0; i < count; ++i) result.push_back(std::exp2(std::floor(exponent(random))) * mantissa(random));
    return result;
}

ExactSum sum_of(const std::vector<double>& values) {
    ExactSum sum;
    for (const double v : values) sum.add(v);
    return sum;
}

TEST(ExactSum, DependsNeitherOnOrderNorOnGrouping) {
    std::mt19937 random(7);
    for (unsigned seed = 0; seed < 200; ++seed) {
        std::vector<double> values = samples(257, seed);
        const ExactSum whole = sum_of(values);
        std::ranges::shuffle(values, random);
        EXPECT_EQ(sum_of(values), whole);
        std::vector<ExactSum> parts(1 + random() % 20);
        for (const double v : values) parts[random() % parts.size()].add(v);
        std::ranges::shuffle(parts, random);
        ExactSum of_parts;
        for (const ExactSum& part : parts) of_parts.add(part);
        EXPECT_EQ(of_parts, whole);
    }
}

// The control: sums of doubles do depend on the order.
TEST(ExactSum, DoublesDependOnTheOrder) {
    std::vector<double> values = samples(257, 1);
    double forwards = 0, backwards = 0;
    for (const double v : values) forwards += v;
    std::ranges::reverse(values);
    for (const double v : values) backwards += v;
    EXPECT_NE(forwards, backwards);
}

TEST(ExactSum, RoundsEachSummandToTheUnit) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const std::vector<double> values = samples(1000, seed);
        long double exact = 0; // 64 bits hold multiples of the unit up to 2^12
        ExactSum sum;
        for (const double v : values) {
            if (v >= 2) continue;
            exact += v;
            sum.add(v);
        }
        EXPECT_LE(std::abs(double(exact - sum.whole() - sum.fraction())), 1000 * ExactSum::unit / 2);
    }
}

TEST(ExactSum, HasOneFormForEachNumber) {
    ExactSum up, down;
    up.add(3.5);
    down.add(4.5);
    down.add(-1);
    EXPECT_EQ(up, down);
    EXPECT_EQ(up.fraction(), 0.5);
    ExactSum negative;
    negative.add(-0.5);
    EXPECT_EQ(negative.whole(), -1);
    EXPECT_EQ(negative.fraction(), 0.5);
    EXPECT_EQ(ExactSum::of(down.whole(), down.fraction()), down);
}

TEST(ExactSum, SubtractionLeavesNothing) {
    ExactSum sum;
    const std::vector<double> values = samples(100, 3);
    for (const double v : values) sum.add(v);
    for (const double v : values) sum.add(-v);
    EXPECT_EQ(sum, ExactSum());
}

TEST(ExactSum, BeyondItsRangeRoundsAsDoublesDo) {
    ExactSum sum;
    double of_doubles = 0;
    for (int i = 0; i < 1000; ++i) {
        sum.add(3.3e38);
        sum.add(0.25);
        of_doubles += 3.3e38;
    }
    EXPECT_NEAR(sum.value() / of_doubles, 1, 1e-12);
    ExactSum tiny;
    tiny.add(1e-300);
    EXPECT_EQ(tiny.value(), 0);
}

TEST(ExactSum, NumbersRoundedForSumsAddExactly) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double> values;
    for (int i = 0; i < 10000; ++i) {
        const double v = uniform(random);
        values.push_back(rounded_for_sums(v));
        EXPECT_LE(std::abs(values.back() - v), 0x1p-33);
    }
    double forwards = 0, backwards = 0;
    for (const double v : values) forwards += v;
    std::ranges::reverse(values);
    for (const double v : values) backwards += v;
    EXPECT_EQ(forwards, backwards);
}

} // namespace
} // namespace blush::test
