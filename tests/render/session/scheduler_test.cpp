#include "render/session/scheduler.h"
#include "tests/render/session/scheduler_machine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace blush::TEST_FILE {
namespace {

using test::endless;
using test::Machine;
using test::trained;

TEST(Scheduler, FirstImageIsTheFinestThatFits) {
    for (const double sample_seconds : {0.001, 0.02, 0.03, 0.09, 0.3, 0.7}) {
        const Scheduler scheduler = trained({sample_seconds}, endless());
        const int d = scheduler.next().divider;
        EXPECT_LE(sample_seconds / (d * d), Scheduler::first_image_seconds) << sample_seconds;
        if (d > 1) { EXPECT_GT(sample_seconds / ((d - 1) * (d - 1)), Scheduler::first_image_seconds) << "a finer one would have fitted"; }
    }
}

TEST(Scheduler, FirstImagesKeepTheirSizeWhileTimingsVary) {
    // Just at the border between 1/3 and 1/4: a sample takes 9/60 s, more or less.
    Scheduler scheduler = trained({9 * Scheduler::first_image_seconds}, endless());
    const int first = scheduler.next().divider;
    for (int edit = 0; edit < 20; ++edit) {
        const double noise = edit % 2 == 0 ? 1.08 : 0.92;
        Machine{9 * Scheduler::first_image_seconds * noise}.run(scheduler, 8);
        scheduler.restart(endless(), true);
        EXPECT_EQ(scheduler.next().divider, first) << "edit " << edit;
    }
    Machine{20 * Scheduler::first_image_seconds}.run(scheduler, 50);
    scheduler.restart(endless(), true);
    EXPECT_EQ(scheduler.next().divider, 5) << "a scene that became slower";
}

// Walks from kept seeds make first samples slower, and the pilots discard them.
TEST(Scheduler, ImagesThatBeginWithSeedsHaveTimingsOfTheirOwn) {
    constexpr double plain = 0.1, decided = 0.2, seeded = 0.9;
    const auto run = [](Scheduler& scheduler, bool seeds, int64_t spp = 0) {
        RenderSettings settings = endless();
        settings.spp = spp;
        scheduler.restart(settings, true);
        if (seeds) scheduler.expect_seeds();
        std::vector<Work> done;
        while (!scheduler.finished() && scheduler.samples() < 8) {
            const Work work = scheduler.next();
            done.push_back(work);
            const bool first = work.divider > 1 || work.first_sample == 0;
            const Machine machine{!first || work.decides ? decided : seeds ? seeded : plain};
            machine.do_work(scheduler, work);
        }
        return done;
    };
    const auto fits = [](const Work& first, double sample_seconds) {
        return first.divider == trained({sample_seconds}, endless()).next().divider;
    };
    const auto first_of_full_size = [](const std::vector<Work>& done) {
        return *std::ranges::find_if(done, [](const Work& w) { return w.divider == 1; });
    };
    Scheduler scheduler;
    run(scheduler, false);
    const std::vector<Work> before = run(scheduler, false);
    EXPECT_TRUE(fits(before.front(), plain));
    EXPECT_FALSE(first_of_full_size(before).decides);
    EXPECT_TRUE(before.back().decides);

    const std::vector<Work> unknown = run(scheduler, true);
    EXPECT_GT(unknown.front().divider, before.front().divider) << "expected to be slower than decided samples";
    const std::vector<Work> known = run(scheduler, true);
    EXPECT_TRUE(fits(known.front(), seeded)) << known.front().divider;
    EXPECT_TRUE(first_of_full_size(known).decides);
    EXPECT_TRUE(fits(run(scheduler, false).front(), plain)) << "these keep their own";

    EXPECT_FALSE(first_of_full_size(run(scheduler, true, 1)).decides) << "an image of one sample has no pilots";
}

// They count as time of the sample that they belong to.
TEST(Scheduler, LightPathsThatTheFirstSampleLacksComeNext) {
    Scheduler whole = trained({0.2}, endless()), parts = whole;
    const auto first = [](Scheduler& scheduler, double seconds) {
        for (Work work = scheduler.next();; work = scheduler.next()) {
            scheduler.record_render(work, work.divider == 1 ? seconds : 0.001);
            if (work.divider == 1) return;
        }
    };
    first(whole, 0.8);
    first(parts, 0.2);
    for (int k = 0; k < 3; ++k) {
        const Work work = parts.next(true);
        EXPECT_TRUE(work.completes && work.publish);
        EXPECT_FALSE(work.clear || work.decides);
        EXPECT_EQ(work.count, 0);
        EXPECT_EQ(work.divider, 1);
        parts.record_render(work, 0.2);
        EXPECT_EQ(parts.samples(), 1);
    }
    EXPECT_FALSE(parts.next().completes);
    EXPECT_DOUBLE_EQ(parts.seconds(), whole.seconds());
    EXPECT_DOUBLE_EQ(parts.timings().sample_seconds, whole.timings().sample_seconds);
}

TEST(Scheduler, FirstImageHasAMinimumSize) {
    EXPECT_EQ(trained({1000}, endless(8192, 8192)).next().divider, Scheduler::coarsest_divider);
    for (const int width : {1, 16, 95, 100, 200, 400, 1280, 4000}) {
        const int d = trained({1000}, endless(width, 3)).next().divider;
        EXPECT_TRUE(d == 1 || width / d >= Scheduler::min_long_side) << width << " / " << d;
    }
    EXPECT_EQ(trained({1000}, endless(1, 1)).next().divider, 1);
}

TEST(Scheduler, AssumesASpeedBeforeItHasMeasured) {
    Scheduler scheduler;
    scheduler.restart(endless(64, 64), true);
    EXPECT_EQ(scheduler.next().divider, 1) << "a small image needs no coarse version";
    scheduler.restart(endless(4096, 4096), true);
    EXPECT_GT(scheduler.next().divider, 1);
}

TEST(Scheduler, NonInteractiveItBeginsAtFullResolution) {
    Scheduler scheduler = trained({1000}, endless());
    scheduler.restart(endless(), false);
    EXPECT_EQ(scheduler.next().divider, 1);
}

TEST(Scheduler, FirstImageIsAlwaysFinishedAndShown) {
    for (const double sample_seconds : {0.001, 0.1, 5.0}) {
        const Machine machine{sample_seconds};
        Scheduler scheduler = trained(machine, endless());
        const std::vector<Work> done = machine.run(scheduler, 20);
        EXPECT_TRUE(done[0].clear && done[0].publish && done[0].always_finish);
        EXPECT_EQ(done[0].count, 1);
        for (size_t i = 1; i < done.size(); ++i) EXPECT_FALSE(done[i].always_finish) << "work " << i;
    }
}

TEST(Scheduler, FullResolutionIsNextAndStays) {
    const auto dividers = [](double sample_seconds) {
        const Machine machine{sample_seconds};
        Scheduler scheduler = trained(machine, endless());
        std::vector<int> d;
        for (const Work& work : machine.run(scheduler, 8)) {
            EXPECT_EQ(work.clear, d.empty() || work.divider != d.back()) << "clears when and only when the film changes size";
            d.push_back(work.divider);
        }
        return d;
    };
    EXPECT_EQ(dividers(0.001), (std::vector{1, 1, 1, 1, 1, 1, 1, 1}));
    EXPECT_EQ(dividers(0.1875), (std::vector{5, 5, 5, 1, 1, 1, 1, 1}));
    EXPECT_EQ(dividers(1), (std::vector{11, 11, 11, 11, 11, 1, 1, 1})) << "no intermediate size";
}

TEST(Scheduler, CoarseImagesGetSamplesForAShareOfAFullOne) {
    for (const double sample_seconds : {0.05, 0.1, 0.2, 0.7, 5.0})
        for (const int64_t spp : {0, 1, 5, 64}) {
            RenderSettings settings = endless();
            settings.first_sample = spp > 0 ? 3 : 0;
            settings.spp = spp > 0 ? spp + 3 : 0;
            const Machine machine{sample_seconds};
            Scheduler scheduler = trained(machine, settings);
            const int divider = scheduler.next().divider;
            double seconds = 0;
            int64_t samples = 0;
            for (Work work = scheduler.next(); work.divider == divider && divider > 1; work = scheduler.next()) {
                EXPECT_EQ(work.first_sample, settings.first_sample + samples);
                EXPECT_TRUE(work.publish);
                samples += work.count;
                seconds += machine.seconds(work);
                machine.do_work(scheduler, work);
            }
            EXPECT_TRUE(spp == 0 || samples <= spp) << samples << " of " << spp;
            // The first image is made in any case.
            const double first = sample_seconds / (divider * divider);
            EXPECT_LE(seconds, std::max(first, Scheduler::coarse_share * sample_seconds * (1 + 1e-9))) << sample_seconds;
            if (spp == 0 && divider > 1) {
                EXPECT_GT(2 * seconds, Scheduler::coarse_share * sample_seconds * (1 - 1e-9)) << sample_seconds;
            }
        }
}

TEST(Scheduler, SamplesOfTheFullImageAreDoneOnceAndInOrder) {
    for (const int64_t first : {0, 7, 1000}) {
        for (const int64_t count : {1, 2, 3, 17, 64, 5000}) {
            RenderSettings settings = endless();
            settings.first_sample = first;
            settings.spp = first + count;
            const Machine machine{0.03};
            Scheduler scheduler = trained(machine, settings);
            int64_t next = first;
            for (const Work& work : machine.run(scheduler)) {
                if (work.divider > 1) {
                    EXPECT_EQ(work.first_sample, first);
                    continue;
                }
                EXPECT_EQ(work.first_sample, next);
                EXPECT_GT(work.count, 0);
                next += work.count;
            }
            EXPECT_EQ(next, settings.spp);
            EXPECT_EQ(scheduler.samples(), count);
        }
    }
}

TEST(Scheduler, BatchesDouble) {
    const Machine machine{1e-4};
    Scheduler scheduler = trained(machine, endless());
    int64_t samples = 0;
    for (const Work& work : machine.run(scheduler, 7)) {
        EXPECT_EQ(work.count, std::max<int64_t>(1, samples));
        EXPECT_TRUE(work.publish || samples >= 8) << "the first frames are urgent";
        samples += work.count;
    }
    EXPECT_EQ(samples, 64);
}

TEST(Scheduler, DisplayIntervalsGrowUpToALimit) {
    const auto longest_wait = [](double now) { return now < 1 ? 0.1 : now < 4 ? 0.25 : now < 15 ? 0.5 : 1; };
    for (const double sample_seconds : {0.0005, 0.004, 0.03, 0.4}) {
        const Machine machine{sample_seconds};
        Scheduler scheduler = trained(machine, endless());
        double now = 0, shown = 0;
        int images = 0;
        while (now < 60) {
            const Work work = scheduler.next();
            machine.do_work(scheduler, work);
            now += machine.seconds(work);
            if (!work.publish) continue;
            ++images;
            EXPECT_LE(now - shown, longest_wait(now) + sample_seconds + 1e-9) << "at " << now << " of " << sample_seconds;
            if (shown > 16) { EXPECT_GE(now - shown, 0.9 - 1e-9) << "resolving costs"; }
            shown = now;
        }
        EXPECT_LT(images, 130);
    }
}

TEST(Scheduler, StopsAtTheNumberOfSamples) {
    RenderSettings settings = endless();
    for (const int64_t spp : {1, 5, 64}) {
        settings.spp = spp;
        const Machine machine{0.1};
        Scheduler scheduler = trained(machine, settings);
        const std::vector<Work> done = machine.run(scheduler);
        EXPECT_EQ(scheduler.samples(), spp);
        EXPECT_TRUE(done.back().publish) << "the last image is shown";
    }
}

TEST(Scheduler, StopsAtTheTimeWithinOneSample) {
    RenderSettings settings = endless();
    settings.seconds = 2;
    for (const double sample_seconds : {0.001, 0.07, 0.3, 3.0}) {
        const Machine machine{sample_seconds};
        Scheduler scheduler = trained(machine, settings);
        const std::vector<Work> done = machine.run(scheduler);
        EXPECT_GE(scheduler.seconds(), settings.seconds);
        EXPECT_LE(scheduler.seconds(), settings.seconds + sample_seconds + 1e-9);
        EXPECT_TRUE(done.back().publish);
        EXPECT_EQ(done.back().divider, 1);
    }
}

TEST(Scheduler, StopsAtTheErrorOfTheFullImageOnly) {
    RenderSettings settings = endless();
    settings.error = 0.01;
    const Machine machine{0.2};
    Scheduler scheduler = trained(machine, settings);
    ASSERT_GT(scheduler.next().divider, 1);
    machine.run(scheduler);
    EXPECT_GE(scheduler.samples(), 100);
    EXPECT_LE(scheduler.samples(), 110);
}

TEST(Scheduler, RequestsAnEstimateWhenTheErrorMayBeReached) {
    RenderSettings settings = endless(64, 64);
    Scheduler scheduler;
    const auto render = [&](int64_t samples) {
        while (scheduler.samples() < samples) scheduler.record_render({.first_sample = scheduler.samples(), .count = 1}, 0.01);
    };
    for (const double target : {0.0, 0.1}) {
        settings.error = target;
        scheduler.restart(settings, true);
        render(100);
        EXPECT_FALSE(scheduler.error_may_be_reached()) << "the error is unknown";
        scheduler.record_error(0.2);
        render(150);
        EXPECT_FALSE(scheduler.error_may_be_reached()) << "50 % more samples do not halve the error";
        render(170);
        EXPECT_EQ(scheduler.error_may_be_reached(), target > 0) << "if it falls fast";
        EXPECT_FALSE(scheduler.finished()) << "it was not measured";
    }
}

TEST(Scheduler, AnUnknownErrorStopsNothing) {
    RenderSettings settings = endless();
    settings.error = 0.5;
    Scheduler scheduler = trained({}, settings);
    for (const double error : {-1.0, std::numeric_limits<double>::quiet_NaN(), 0.6}) {
        const Work work = scheduler.next();
        scheduler.record_render(work, 0.001);
        scheduler.record_publish();
        scheduler.record_error(error);
        EXPECT_FALSE(scheduler.finished()) << error;
    }
}

TEST(Scheduler, TheNearestStopRuleWins) {
    RenderSettings settings = endless();
    settings.spp = 1000;
    settings.seconds = 100;
    settings.error = 0.1;
    Scheduler scheduler = trained({}, settings);
    Machine{0.001}.run(scheduler);
    EXPECT_LT(scheduler.samples(), 1000);
    EXPECT_LT(scheduler.seconds(), 100);
    settings.error = 1e-9;
    scheduler.restart(settings, true);
    Machine{0.001}.run(scheduler);
    EXPECT_EQ(scheduler.samples(), 1000);
    settings.seconds = 0.5;
    scheduler.restart(settings, true);
    Machine{0.001}.run(scheduler);
    EXPECT_LT(scheduler.samples(), 1000);
    EXPECT_NEAR(scheduler.seconds(), 0.5, 0.001 + 1e-9);
}

TEST(Scheduler, ProgressGrowsAndIsOneOnlyWhenFinished) {
    std::vector<RenderSettings> rules(4, endless());
    rules[0].spp = 200;
    rules[1].seconds = 3;
    rules[2].error = 0.004;
    rules[3].spp = 100000;
    rules[3].seconds = 3;
    rules[3].error = 0.0001;
    const Machine machine{0.02};
    for (const RenderSettings& settings : rules) {
        Scheduler scheduler = trained(machine, settings);
        double last = 0;
        EXPECT_EQ(scheduler.progress(), 0);
        while (!scheduler.finished()) {
            machine.do_work(scheduler, scheduler.next());
            EXPECT_GE(scheduler.progress(), last);
            last = scheduler.progress();
            EXPECT_EQ(last == 1, scheduler.finished());
        }
        EXPECT_EQ(last, 1);
    }
    Scheduler scheduler = trained(machine, endless());
    machine.run(scheduler, 100);
    EXPECT_EQ(scheduler.progress(), 0) << "without a stop rule there is no progress";
}

TEST(Scheduler, OtherStopRulesContinueTheSameImage) {
    RenderSettings settings = endless();
    settings.spp = 16;
    const Machine machine{0.05};
    Scheduler scheduler = trained(machine, settings);
    machine.run(scheduler);
    settings.spp = 64;
    scheduler.change_stop_rules(settings);
    EXPECT_FALSE(scheduler.finished());
    EXPECT_NEAR(scheduler.progress(), 0.25, 1e-12);
    const Work work = scheduler.next();
    EXPECT_EQ(work.first_sample, 16);
    EXPECT_EQ(work.divider, 1);
    EXPECT_FALSE(work.clear);
    settings.spp = 8;
    scheduler.change_stop_rules(settings);
    EXPECT_TRUE(scheduler.finished());
    EXPECT_EQ(scheduler.samples(), 16) << "finished samples stay";
}

TEST(Scheduler, RestartForgetsTheImageAndKeepsTheTimings) {
    const Machine machine{0.3};
    Scheduler scheduler = trained(machine, endless());
    const int divider = scheduler.next().divider;
    machine.run(scheduler, 30);
    scheduler.restart(endless(), true);
    EXPECT_EQ(scheduler.samples(), 0);
    EXPECT_EQ(scheduler.seconds(), 0);
    EXPECT_EQ(scheduler.next().divider, divider);
    EXPECT_NEAR(scheduler.timings().sample_seconds, machine.sample_seconds, 1e-6);
}

// As with what pilots learn: light paths, or learned roulette.
TEST(Scheduler, SlowerLaterSamplesDoNotDelayTheFirst) {
    const Machine machine{0.3}, later{0.9};
    const auto first_image = [&](Scheduler& scheduler) {
        std::vector<std::pair<int, int64_t>> works;
        do {
            const Work work = scheduler.next();
            works.emplace_back(work.divider, work.count);
            machine.do_work(scheduler, work);
        } while (scheduler.samples() == 0);
        return works;
    };
    Scheduler same = trained(machine, endless()), slower = same;
    EXPECT_EQ(first_image(same), first_image(slower));
    machine.run(same, 30);
    later.run(slower, 30);
    EXPECT_GT(slower.timings().sample_seconds, 2 * same.timings().sample_seconds);
    same.restart(endless(), true);
    slower.restart(endless(), true);
    const auto works = first_image(same);
    EXPECT_GT(works.size(), 2u);
    EXPECT_EQ(works, first_image(slower));
}

} // namespace
} // namespace blush::TEST_FILE
