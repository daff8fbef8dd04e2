// Discrete sampling: the reported probability of an index is bit-exact.
#include "core/distribution.h"

#include "tests/support/statistics.h"

#include <random>

namespace blush::TEST_FILE {

using namespace statistics;

namespace {

DiscreteSample<float> draw(const std::vector<uint32_t>& thresholds, uint32_t bits) {
    return sample_discrete<float>(thresholds.data(), 0, int(thresholds.size()), bits);
}
float probability(const std::vector<uint32_t>& thresholds, int index) {
    return discrete_probability<float>(thresholds.data(), 0, int(thresholds.size()), index);
}

std::vector<std::vector<double>> examples() {
    std::mt19937 random(4);
    std::vector<std::vector<double>> all = {{1},       {0},        {1, 1},     {1, 3},           {0, 1}, {1, 0}, {0, 0, 5, 0, 1, 0, 0},
                                            {0, 0, 0}, {1e-30, 1}, {1, 1e-30}, {1e300, 1e300, 1}};
    for (const size_t n : {3u, 8u, 17u, 100u, 1025u}) {
        std::vector<double> weights(n);
        for (double& w : weights) w = random() % 4 == 0 ? 0 : std::exp(20 * (double(random()) / 0x1p32 - 0.5));
        all.push_back(weights);
    }
    return all;
}

} // namespace

// Tests the ends of each index's interval [thresholds[i], thresholds[i + 1]).
TEST(Distribution, ProbabilitiesAreBitExact) {
    for (const std::vector<double>& weights : examples()) {
        const std::vector<uint32_t> thresholds = make_thresholds(weights);
        const size_t n = weights.size();
        ASSERT_EQ(thresholds.size(), n);
        EXPECT_EQ(thresholds[0], 0u);
        double sum = 0;
        for (size_t i = 0; i < n; ++i) {
            const uint64_t low = thresholds[i], high = i + 1 < n ? thresholds[i + 1] : uint64_t(1) << 32;
            ASSERT_LE(low, high);
            const double exact = double(high - low) * 0x1p-32;
            sum += exact;
            EXPECT_NEAR(probability(thresholds, int(i)), exact, exact * 0x1p-23);
            if (low == high) continue;
            for (const uint64_t bits : {low, (low + high) / 2, high - 1}) {
                const DiscreteSample<float> s = draw(thresholds, uint32_t(bits));
                EXPECT_EQ(s.index, int(i));
                EXPECT_EQ(s.probability, probability(thresholds, int(i)));
                const double within = double(bits - low) / double(high - low);
                EXPECT_NEAR(s.remainder, within, 4 * 0x1p-24);
                EXPECT_TRUE(s.remainder >= 0 && s.remainder < 1);
            }
        }
        EXPECT_EQ(sum, 1);
    }
}

TEST(Distribution, ProbabilitiesAreTheWeights) {
    for (const std::vector<double>& weights : examples()) {
        const std::vector<uint32_t> thresholds = make_thresholds(weights);
        const size_t n = weights.size();
        const double most = *std::max_element(weights.begin(), weights.end());
        double total = 0;
        for (const double w : weights) total += w / (most > 0 ? most : 1);
        size_t last_positive = 0;
        for (size_t i = 0; i < n; ++i)
            if (weights[i] > 0) last_positive = i;
        for (size_t i = 0; i < n; ++i) {
            const double expected = most > 0 ? weights[i] / most / total : 1 / double(n);
            EXPECT_NEAR(probability(thresholds, int(i)), expected, double(n + 1) * 0x1p-32 + expected * 0x1p-22);
            if (weights[i] > 0 || most == 0)
                EXPECT_GT(probability(thresholds, int(i)), 0.f);
            else if (i < last_positive)
                EXPECT_EQ(probability(thresholds, int(i)), 0.f);
            else
                EXPECT_LE(probability(thresholds, int(i)), float(n) * 0x1p-32f);
        }
    }
}

TEST(Distribution, OneWeightIsCertain) {
    const std::vector<uint32_t> thresholds = make_thresholds(std::vector<double>{0.25});
    for (const uint32_t bits : {0u, 1u, 0x80000000u, 0xffffffffu}) {
        EXPECT_EQ(draw(thresholds, bits).index, 0);
        EXPECT_EQ(draw(thresholds, bits).probability, 1.f);
        EXPECT_LT(draw(thresholds, bits).remainder, 1.f);
    }
}

TEST(Distribution, SamplesFollowTheWeights) {
    const std::vector<double> weights = {3, 0, 1, 0.5, 0, 7, 2, 0.01};
    const std::vector<uint32_t> thresholds = make_thresholds(weights);
    std::mt19937 random(5);
    constexpr int64_t samples = 400'000;
    std::vector<int64_t> counts(weights.size());
    Moments remainder;
    for (int64_t i = 0; i < samples; ++i) {
        const DiscreteSample<float> s = draw(thresholds, uint32_t(random()));
        ++counts[size_t(s.index)];
        remainder.add(s.remainder);
    }
    std::vector<double> expected;
    for (size_t i = 0; i < weights.size(); ++i) expected.push_back(double(samples) * probability(thresholds, int(i)));
    EXPECT_TRUE(chi_squared_test(counts, expected));
    EXPECT_TRUE(z_test(remainder, 0.5));
}

TEST(Distribution, EveryWeightOfTheLargestTableIsSampled) {
    constexpr int n = 1 << 24;
    std::vector<double> weights(n, 1e-9);
    weights[12345] = 1;
    const std::vector<uint32_t> thresholds = make_thresholds(weights);
    for (const int i : {0, 1, 12344, 12345, 12346, n / 2, n - 1}) {
        ASSERT_GT(probability(thresholds, i), 0.f) << i;
        const DiscreteSample<float> s = draw(thresholds, thresholds[size_t(i)]);
        EXPECT_EQ(s.index, i);
        EXPECT_EQ(s.probability, probability(thresholds, i));
    }
    EXPECT_EQ(draw(thresholds, 0xffffffffu).index, n - 1);
}

TEST(Distribution, LanesEqualOnePathBitForBit) {
    const std::vector<double> weights = examples().back();
    std::vector<uint32_t> thresholds = make_thresholds(weights);
    // Several tables in one array, as for lights: lanes sample from different tables.
    const int n = int(thresholds.size());
    const std::vector<uint32_t> second = make_thresholds(std::vector<double>(weights.rbegin(), weights.rend()));
    thresholds.insert(thresholds.end(), second.begin(), second.end());
    std::mt19937 random(6);
    for (int round = 0; round < 5000; ++round) {
        uint32_t bits[64];
        int32_t first[64];
        for (int i = 0; i < 64; ++i) bits[i] = uint32_t(random()), first[i] = random() % 2 ? n : 0;
        const DiscreteSample<Wide> wide = sample_discrete<Wide>(thresholds.data(), load<WideInt>(first), n, load<WideUInt>(bits));
        for (int i = 0; i < width<Wide>; ++i) {
            const DiscreteSample<float> one = sample_discrete<float>(thresholds.data(), first[i], n, bits[i]);
            ASSERT_EQ(one.index, lane(wide.index, i));
            ASSERT_EQ(float_bits(one.probability), float_bits(lane(wide.probability, i)));
            ASSERT_EQ(float_bits(one.remainder), float_bits(lane(wide.remainder, i)));
        }
    }
}

} // namespace blush::TEST_FILE
