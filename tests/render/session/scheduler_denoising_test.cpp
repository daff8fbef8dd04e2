// The scheduler while denoised images are shown.
#include "render/session/scheduler.h"
#include "tests/render/session/scheduler_machine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace blush::TEST_FILE {
namespace {

using test::endless;
using test::Machine;
using test::trained;

TEST(SchedulerDenoising, FirstImageLeavesTimeForDenoising) {
    const double pixels = 1280 * 720, sample_seconds = 0.2;
    for (const double denoising : {0.1, 0.2, 0.4, 1.0}) {
        Scheduler scheduler = trained({sample_seconds}, endless());
        scheduler.expect_denoising({.coarse = denoising / pixels});
        const int d = scheduler.next().divider;
        EXPECT_LE((sample_seconds + denoising) / (d * d), Scheduler::first_denoised_seconds * Scheduler::timing_tolerance) << denoising;
        EXPECT_LE(sample_seconds / (d * d), Scheduler::first_image_seconds) << denoising;
    }
    Scheduler slow = trained({sample_seconds}, endless());
    slow.expect_denoising({.coarse = 20 / pixels});
    EXPECT_EQ(slow.next().divider, trained({sample_seconds}, endless()).next().divider) << "denoising that would not be in time";
    Scheduler fast = trained({0.001}, endless());
    fast.expect_denoising({.coarse = 0.1 / pixels});
    EXPECT_EQ(fast.next().divider, 1) << "full resolution needs no coarse image";
}

TEST(SchedulerDenoising, FirstImageLeavesTimeForHistory) {
    const double pixels = 1280 * 720, sample_seconds = 0.2, denoising = 2e-7;
    int last = 0;
    for (const double history : {0.0, 0.006, 0.01, 1.0}) {
        Scheduler scheduler = trained({sample_seconds}, endless());
        scheduler.expect_denoising({.coarse = denoising, .finishing = history});
        const int d = scheduler.next().divider;
        const double left = std::max(Scheduler::first_denoised_seconds - history, Scheduler::first_denoised_seconds / 2);
        EXPECT_LE((sample_seconds + pixels * denoising) / (d * d), left * Scheduler::timing_tolerance) << history;
        EXPECT_GE(d, last);
        last = d;
    }
}

// The works of a new image, until one of full size.
std::vector<Work> coarse_works(const Machine& machine, const RenderSettings& settings, const Scheduler::DenoisingTimes& times) {
    Scheduler scheduler = trained(machine, settings);
    scheduler.expect_denoising(times);
    std::vector<Work> works;
    for (Work work = scheduler.next(); work.divider > 1; work = scheduler.next()) {
        works.push_back(work);
        machine.do_work(scheduler, work);
        if (works.size() > 100) break;
    }
    return works;
}

TEST(SchedulerDenoising, WithDenoisingASecondCoarseImageIsFiner) {
    const double pixels = 1280 * 720, denoising = 0.78;
    for (const double sample_seconds : {0.2, 0.35, 0.7, 2.0}) {
        const std::vector<Work> works = coarse_works({sample_seconds}, endless(), {.coarse = 1.5 / pixels, .whole = denoising / pixels});
        ASSERT_GE(works.size(), 3u) << sample_seconds;
        EXPECT_EQ(works[0].count, 1);
        EXPECT_EQ(works[1].divider, works[0].divider);
        EXPECT_EQ(works[1].first_sample, 1);
        EXPECT_EQ(works[1].count, Scheduler::refined_samples - 1);
        EXPECT_FALSE(works[1].clear);
        EXPECT_EQ(works[2].first_sample, 0);
        EXPECT_EQ(works[2].count, Scheduler::refined_samples);
        EXPECT_TRUE(works[2].clear);
        for (const Work& work : works) EXPECT_TRUE(work.publish);
        for (size_t i = 3; i < works.size(); ++i) {
            EXPECT_EQ(works[i].divider, works[2].divider) << "a slow scene: more samples";
            EXPECT_FALSE(works[i].clear);
        }
        const int d = works[2].divider;
        EXPECT_LE(Scheduler::least_refinement * d, works[0].divider) << sample_seconds;
        const double budget = Scheduler::refined_share * (sample_seconds + denoising);
        const double whole = double(Scheduler::refined_samples) * sample_seconds + denoising;
        EXPECT_LE(whole / (d * d), budget * (1 + 1e-9)) << sample_seconds;
        EXPECT_GT(whole / ((d - 1) * (d - 1)), budget * (1 - 1e-9)) << "a finer one would have fitted";
    }
}

TEST(SchedulerDenoising, OneCoarseImageSufficesWithoutDenoisingAndForFewSamples) {
    const double pixels = 1280 * 720, sample_seconds = 0.35;
    const Scheduler::DenoisingTimes times{.coarse = 1.5 / pixels, .whole = 0.78 / pixels};
    RenderSettings few = endless();
    few.spp = Scheduler::refined_samples - 1;
    const auto sizes = [&](double seconds, const RenderSettings& settings, const Scheduler::DenoisingTimes& denoising) {
        std::vector<int> dividers;
        for (const Work& work : coarse_works({seconds}, settings, denoising))
            if (dividers.empty() || dividers.back() != work.divider) dividers.push_back(work.divider);
        return dividers.size();
    };
    EXPECT_EQ(sizes(sample_seconds, endless(), times), 2u);
    EXPECT_EQ(sizes(sample_seconds, endless(), {}), 1u);
    EXPECT_EQ(sizes(sample_seconds, endless(), {.coarse = 1.5 / pixels}), 1u) << "the time of the whole image is not known";
    EXPECT_EQ(sizes(sample_seconds, few, times), 1u);
    EXPECT_EQ(sizes(0.02, endless(), times), 1u) << "it would be hardly finer";
}

} // namespace
} // namespace blush::TEST_FILE
