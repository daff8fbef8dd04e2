// The scaling table: known cases, and the rule of the chunk.
#include "app/commands/plan/scaling.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

TEST(PlanScaling, WithoutOverheadItIsLinearUpToTheNumberOfTasks) {
    const MeasuredCosts costs{.sample = 1};
    const Workload work{.looks = 2, .spp = 64, .chunk = 8};
    for (const int64_t workers : {1, 2, 4, 8, 16}) {
        const Scaling row = simulate(costs, work, workers);
        EXPECT_DOUBLE_EQ(row.seconds, 128.0 / double(workers));
        EXPECT_DOUBLE_EQ(row.efficiency, 1);
    }
    EXPECT_DOUBLE_EQ(simulate(costs, work, 10000).seconds, 8);
    EXPECT_EQ(knee_of(scaling_table(costs, work)), 16);
}

TEST(PlanScaling, CountsStartsWritesAndMerges) {
    const MeasuredCosts costs{.start = 3, .sample = 1, .write = 2, .read = 0.5};
    // Chunks of 8, 8 and 4 samples: 13 + 13 + 9 s. The merge reads three parts and writes: 3.5 s. One process: 3 + 20 + 2 s.
    const Workload work{.looks = 1, .spp = 20, .chunk = 8};
    EXPECT_DOUBLE_EQ(simulate(costs, work, 1).seconds, 38.5);
    EXPECT_DOUBLE_EQ(plan_overhead(costs, work), 38.5 / 25 - 1);
    EXPECT_DOUBLE_EQ(simulate(costs, work, 2).seconds, 22 + 3.5);
    EXPECT_DOUBLE_EQ(simulate(costs, work, 3).seconds, 13 + 3.5);
}

TEST(PlanScaling, ChunkIsTheSmallestWithLittleOverhead) {
    const MeasuredCosts costs{.start = 0.5, .sample = 0.1, .write = 0.1, .read = 0.1};
    const int64_t looks = 3, spp = 1 << 14, chunk = choose_chunk(costs, looks, spp);
    EXPECT_EQ(chunk & (chunk - 1), 0);
    EXPECT_LT(plan_overhead(costs, {looks, spp, chunk}), 0.03);
    EXPECT_GE(plan_overhead(costs, {looks, spp, chunk / 2}), 0.03);
}

TEST(PlanScaling, ChunkForManyWorkersEndsFirst) {
    const MeasuredCosts costs{.start = 1, .sample = 2, .write = 10, .read = 7};
    const int64_t spp = 4096, chunk = choose_chunk_for(costs, 1, spp, 64);
    EXPECT_EQ(chunk & (chunk - 1), 0);
    EXPECT_LT(chunk, choose_chunk(costs, 1, spp)) << "more parts than one worker likes";
    for (int64_t other = 1; other <= spp; other *= 2)
        EXPECT_LE(simulate(costs, {1, spp, chunk}, 64).seconds, simulate(costs, {1, spp, other}, 64).seconds) << other;
    EXPECT_EQ(choose_chunk_for(costs, 1, spp, 1), spp) << "one worker is quickest with one task";
}

TEST(PlanScaling, LittleWorkIsOneTaskPerLook) {
    const MeasuredCosts costs{.start = 100, .sample = 0.1, .write = 1, .read = 1};
    EXPECT_EQ(choose_chunk(costs, 10, 50), 64);
    EXPECT_EQ(choose_chunk(costs, 10, 1), 1);
    EXPECT_LE((int64_t(1) << 40) / choose_chunk(MeasuredCosts{.sample = 1}, 1, int64_t(1) << 40), 4096) << "parts of one merge";
}

} // namespace
} // namespace blush::TEST_FILE
