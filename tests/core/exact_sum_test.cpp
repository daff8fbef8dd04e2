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
    std::uniform_real_distribution<double> exponent(-100, 100), mantissa(1, 2);
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
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<double> values(257);
    for (double& v : values) v = uniform(random);
    double forwards = 0, backwards = 0;
    for (const double v : values) forwards += v;
    std::ranges::reverse(values);
    for (const double v : values) backwards += v;
    EXPECT_NE(forwards, backwards);
}

// 27 bits of the largest summand, in any order of magnitude.
TEST(ExactSum, IsPreciseInAnyOrderOfMagnitude) {
    for (const double scale : {1e-38, 1e-30, 1e-6, 1.0, 1e12, 1e30, 1e38}) {
        std::mt19937_64 random(9);
        std::uniform_real_distribution<double> uniform(0, scale);
        long double exact = 0;
        ExactSum sum;
        for (int i = 0; i < 100000; ++i) {
            const double x = uniform(random);
            exact += x;
            sum.add(x);
        }
        EXPECT_NEAR(sum.value() / double(exact), 1, 0x1p-27) << scale;
    }
}

TEST(ExactSum, SubtractionLeavesNothing) {
    ExactSum sum;
    const std::vector<double> values = samples(100, 3);
    for (const double v : values) sum.add(v);
    for (const double v : values) sum.add(-v);
    EXPECT_EQ(sum.value(), 0);
}

TEST(ExactSum, ComesBackFromItsTwoNumbers) {
    const ExactSum sum = sum_of(samples(100, 4));
    EXPECT_EQ(ExactSum::of(sum.high(), sum.biased_low()), sum);
    for (const double damaged : {0.0, -1.5, 1.0, 1e300, std::nan(""), double(INFINITY)})
        EXPECT_EQ(ExactSum::of(3, damaged).value(), damaged == 1.0 ? 2.5 : 3) << damaged;
}

// The most summands that are promised, all with the largest remainder.
TEST(ExactSum, HoldsSixteenMillionEqualSummands) {
    ExactSum sum;
    const double x = 7.9999999;
    for (int i = 0; i < 1 << 24; ++i) sum.add(x);
    EXPECT_NEAR(sum.value() / (x * (1 << 24)), 1, 1e-15);
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
