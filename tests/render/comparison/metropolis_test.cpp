// Metropolis light transport: mutations that keep the uniform distribution, chains without bias.
#include "measure/statistics/intervals.h"
#include "render/comparison/primary_samples.h"
#include "tests/render/comparison/comparison_images.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

TEST(PrimarySamples, StayUniformUnderMutations) {
    constexpr int cells = 32, points = 20000;
    std::array<int64_t, cells> counts{};
    for (uint64_t seed = 0; seed < points; ++seed) {
        PrimarySamples numbers(seed);
        numbers.pair(3);
        for (int i = 0; i < 5; ++i) numbers.mutate(i == 2 && seed % 2);
        ++counts[size_t(numbers.pair(3).bits_x >> 27)];
    }
    const std::vector<double> expected(cells, double(points) / cells);
    EXPECT_TRUE(chi_squared_test(counts, expected));
}

TEST(PrimarySamples, SmallStepsAreSmallAndLargeOnesAreNot) {
    double small = 0, large = 0;
    constexpr int trials = 1000;
    for (uint64_t seed = 0; seed < trials; ++seed)
        for (const bool is_large : {false, true}) {
            PrimarySamples numbers(seed);
            const uint32_t before = numbers.pair(0).bits_y;
            numbers.mutate(is_large);
            const auto moved = int32_t(numbers.pair(0).bits_y - before); // the shorter way round
            const double distance = std::abs(double(moved)) * 0x1p-32;
            (is_large ? large : small) += distance / trials;
            if (is_large) continue;
            EXPECT_TRUE(distance >= 1.0 / 1025 && distance <= 1.0 / 63) << distance;
        }
    EXPECT_NEAR(large, 0.25, 0.02); // uniform up to a half
    EXPECT_NEAR(small, (1.0 / 64 - 1.0 / 1024) / std::log(16.0), 0.0003);
}

TEST(PrimarySamples, RejectTakesTheMutationBack) {
    PrimarySamples numbers(7);
    std::vector<uint32_t> before;
    for (uint32_t dimension = 0; dimension < 20; ++dimension) before.push_back(numbers.pair(dimension).bits_x);
    for (const bool large : {false, true, false}) {
        numbers.mutate(large);
        for (uint32_t dimension = 0; dimension < 20; dimension += 2) EXPECT_NE(numbers.pair(dimension).bits_x, before[dimension]);
        numbers.reject();
        for (uint32_t dimension = 0; dimension < 20; ++dimension) EXPECT_EQ(numbers.pair(dimension).bits_x, before[dimension]);
    }
}

TEST(PrimarySamples, AcceptedMutationsReachNumbersThatWereNotRead) {
    PrimarySamples numbers(8);
    const uint32_t before = numbers.pair(0).bits_x;
    numbers.mutate(true);
    numbers.mutate(false);
    numbers.reject();
    EXPECT_NE(numbers.pair(0).bits_x, before) << "the large step stays";
}

TEST(PrimarySamples, SmallStepsLeaveTheFixedDimension) {
    PrimarySamples numbers(9);
    const uint32_t before = numbers.pair(PrimarySamples::fixed_dimension).bits_x;
    numbers.mutate(false);
    EXPECT_EQ(numbers.pair(PrimarySamples::fixed_dimension).bits_x, before);
    numbers.mutate(true);
    EXPECT_NE(numbers.pair(PrimarySamples::fixed_dimension).bits_x, before);
}

// Chains of any length, with many and few large steps.
TEST(Metropolis, IsRightBetweenGlowingWalls) {
    Scene room = glowing_walls();
    room.view = looking({0, 0, 0.9f}, {0, 0, 0}, 1);
    const std::vector<const char*> options{"metropolis", "metropolis,chain=4", "metropolis,large=0.01,chain=64", "metropolis,large=1"};
    for (const char* text : options)
        EXPECT_TRUE(is_mean(integrator_mean(room, settings_for(16, 16, 16), text, 32), 2, sidak(significance, int64_t(options.size()))))
            << text;
}

// Where the image is not one colour: the blocks of the image, not its mean alone.
TEST(Metropolis, AgreesWithPathTracingInEachBlock) {
    const Scene scene = shipped_scene("cornell");
    const auto blocks = [&](const char* integrator, int64_t spp, uint32_t seeds) {
        BlockMoments moments;
        RenderSettings settings = settings_for(24, 24, spp);
        for (settings.seed = 0; settings.seed < seeds; ++settings.seed) {
            moments.add(image_of(*integrator_render(scene, settings, integrator)).blocks(8, 8));
        }
        return moments.measured();
    };
    const std::vector<Measured> path = blocks("path", 64, 24);
    EXPECT_TRUE(same_means(blocks("metropolis", 32, 24), path, sidak(significance, 2)));
    EXPECT_TRUE(same_means(blocks("bidirectional", 32, 24), path, sidak(significance, 2)));
}

TEST(Metropolis, DoesNotDependOnThreadsOrParts) { expect_same_bits_in_parts_and_threads("metropolis,chain=100"); }

// No light and no surface: nothing to mutate.
TEST(Metropolis, DarkScenesAreBlack) {
    Scene scene;
    place(scene, cube(true), lambert(0.5f));
    const Frame frame = integrator_frame(scene, settings_for(8, 8, 2), "metropolis");
    for (size_t i = 0; i < frame.rgba.size(); i += 4) EXPECT_EQ(frame.rgba[i], 0.f);
}

} // namespace
} // namespace blush::test::TEST_FILE
