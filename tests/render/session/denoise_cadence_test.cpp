// DenoiseCadence with simulated timings: no images, no clock.
#include "render/session/denoise_cadence.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace blush::TEST_FILE {
namespace {

using Source = DenoiseCadence::Source;
constexpr DenoiseQuality fast = DenoiseQuality::fast, base = DenoiseQuality::base, high = DenoiseQuality::high;

// Simulates rendering an image of one megapixel, denoised as scheduled; one task at a time.
struct Bench {
    DenoiseCadence cadence;
    double now = 1000;
    std::array<double, 3> seconds{0.1, 0.2, 0.6}; // per megapixel, by quality

    struct Done {
        double at;
        DenoiseQuality quality;
        int64_t samples;
        bool halved;
    };
    std::vector<Done> done;

    void offer(const Source& source) { cadence.offer(source, now); }
    // Runs all due tasks.
    void denoise_if_due(const Source& source) {
        for (auto decision = cadence.next(now); decision.quality; decision = cadence.next(now)) {
            const double took = seconds[size_t(*decision.quality)] * source.megapixels * (decision.halves ? 0.25 : 1);
            done.push_back({now, *decision.quality, source.samples, decision.halves});
            cadence.record(source, decision, now, took, true);
            now += took;
        }
    }
    // Then the time of the small network is known.
    void warm_up() {
        render(999, 4);
        done.clear();
        now = 1000;
    }
    // No further frame comes.
    void idle(const Source& source) {
        for (int i = 0; i < 100; ++i) {
            const double wait = cadence.next(now).wait;
            if (std::isinf(wait)) return;
            ASSERT_GT(wait, 0);
            now += wait + 1e-6;
            denoise_if_due(source);
        }
    }
    // Full-resolution frames, one every tenth of a second; the last one completes the image.
    void render(uint64_t image, int frames) {
        for (int i = 1; i <= frames; ++i) {
            const Source source{image, i, 1, i == frames, 1};
            offer(source);
            denoise_if_due(source);
            now += 0.1;
        }
    }
};

TEST(DenoiseCadence, NothingIsDueBeforeTheFirstFrame) {
    const DenoiseCadence cadence;
    EXPECT_FALSE(cadence.next(0).quality);
    EXPECT_TRUE(std::isinf(cadence.next(0).wait));
}

TEST(DenoiseCadence, TheFirstFullImageIsDenoisedAtOnceByTheSmallNetwork) {
    Bench bench;
    for (uint64_t image = 1; image < 6; ++image) {
        bench.done.clear();
        bench.render(image, 1 + int(image) * 7);
        ASSERT_FALSE(bench.done.empty());
        EXPECT_EQ(bench.done[0].samples, 1) << "image " << image;
        EXPECT_EQ(bench.done[0].quality, fast);
    }
}

// A first sample after an edit gets its light paths part by part.
TEST(DenoiseCadence, MoreLightPathsCountLikeMoreSamples) {
    Bench bench;
    std::vector<double> shares;
    for (int part = 1; part <= 8; ++part) {
        const Source source{1, 1, 1, false, 1, part / 8.0};
        bench.offer(source);
        const size_t before = bench.done.size();
        bench.denoise_if_due(source);
        if (bench.done.size() > before) shares.push_back(source.light_path_share);
        bench.now += 1;
    }
    ASSERT_GE(shares.size(), 4);
    EXPECT_EQ(shares[0], 1 / 8.0);
    EXPECT_EQ(shares[1], 2 / 8.0);
    EXPECT_GT(shares.back(), 0.5);
}

TEST(DenoiseCadence, BetweenRenewalsAtMostOnceASecondAndATenthOfTheTime) {
    for (const double slowness : {0.01, 0.3, 1.0, 5.0}) {
        Bench bench;
        for (double& s : bench.seconds) s *= slowness;
        const double begin = bench.now;
        bench.render(1, 600);
        ASSERT_GE(bench.done.size(), 4u);
        double spent = 0;
        for (size_t i = 0; i < bench.done.size(); ++i) {
            const auto& d = bench.done[i];
            spent += bench.seconds[size_t(d.quality)] * (d.halved ? 0.25 : 1);
            const bool last = i + 1 == bench.done.size();
            // These are guaranteed at any cost.
            if (i == 0 || last || bench.done[i - 1].halved) continue;
            if (d.samples >= DenoiseCadence::renewal_growth * bench.done[i - 1].samples) {
                EXPECT_LE(spent, DenoiseCadence::renewal_share * (d.at - begin) + 1e-9) << "image " << i << " of " << slowness;
                continue;
            }
            EXPECT_GE(d.at, bench.done[i - 1].at + DenoiseCadence::min_interval - 1e-9);
            EXPECT_LE(spent, DenoiseCadence::time_share * (d.at - begin) + 1e-9) << "image " << i << " of " << slowness;
        }
    }
}

// A network that takes 0.8 s for the whole image shows nothing sooner than one of half the size.
TEST(DenoiseCadence, AFirstSampleIsDenoisedAtHalfSizeIfTheFullOneTakesLong) {
    for (const double megapixel_seconds : {0.09, 0.8}) {
        Bench bench;
        bench.seconds[0] = megapixel_seconds;
        bench.warm_up();
        bench.render(1, 20);
        ASSERT_GE(bench.done.size(), 2u);
        EXPECT_EQ(bench.done[0].samples, 1);
        EXPECT_EQ(bench.done[0].halved, megapixel_seconds > DenoiseCadence::quick_seconds) << megapixel_seconds;
        EXPECT_EQ(bench.done[1].quality, fast);
        for (size_t i = 1; i < bench.done.size(); ++i) EXPECT_FALSE(bench.done[i].halved) << i;
        if (bench.done[0].halved) { EXPECT_EQ(bench.done[1].samples, 2) << "at full size as soon as that gains something"; }
    }
}

TEST(DenoiseCadence, PartsOfAFirstSampleAreDenoisedAtHalfSize) {
    Bench bench;
    bench.seconds[0] = 0.8;
    bench.warm_up();
    for (int part = 1; part <= 8; ++part) {
        const Source source{1, 1, 1, false, 1, part / 8.0};
        bench.offer(source);
        bench.denoise_if_due(source);
        bench.now += 0.2;
    }
    ASSERT_GE(bench.done.size(), 3u);
    for (const Bench::Done& d : bench.done) EXPECT_TRUE(d.halved);
}

TEST(DenoiseCadence, WhatIsCompleteOrHasSamplesIsDenoisedAtFullSize) {
    for (const Source& source : {Source{1, 1, 1, true, 1}, Source{1, 2, 1, false, 1}}) {
        Bench bench;
        bench.seconds[0] = 0.8;
        bench.warm_up();
        bench.offer(source);
        bench.denoise_if_due(source);
        ASSERT_FALSE(bench.done.empty());
        EXPECT_FALSE(bench.done[0].halved) << source.samples;
    }
}

TEST(DenoiseCadence, APausedFirstSampleIsDenoisedAtFullSizeWhenIdle) {
    Bench bench;
    bench.seconds = {0.8, 1.6, 4.8};
    bench.warm_up();
    const Source source{1, 1, 1, false, 1};
    bench.offer(source);
    bench.denoise_if_due(source);
    ASSERT_EQ(bench.done.size(), 1u);
    EXPECT_TRUE(bench.done[0].halved);
    bench.idle(source);
    ASSERT_EQ(bench.done.size(), 2u);
    EXPECT_EQ(bench.done[1].quality, base);
    EXPECT_FALSE(bench.done[1].halved);
}

TEST(DenoiseCadence, IsRenewedWhenTheSamplesHaveDoubled) {
    Bench bench;
    bench.warm_up();
    bench.render(1, 20);
    ASSERT_GE(bench.done.size(), 4u);
    EXPECT_EQ(bench.done[0].samples, 1);
    EXPECT_EQ(bench.done[1].samples, 4) << "two runs of 0.1 s are half of the time then";
    EXPECT_EQ(bench.done[2].samples, 8);
    EXPECT_EQ(bench.done[3].samples, 16);
}

TEST(DenoiseCadence, ShortRunsOfTheSmallNetworkPauseRendering) {
    // After a run of so many seconds a megapixel: of the next image, or of the same one much later.
    const auto pauses = [](double speed, double megapixels, uint64_t image, double at) {
        DenoiseCadence cadence;
        const Source source{1, 1, 1, false, megapixels};
        cadence.offer(source, 0);
        if (speed > 0) cadence.record(source, {fast}, 0, speed * megapixels, true);
        cadence.offer({image, 1000, 1, false, megapixels}, at);
        const auto decision = cadence.next(at);
        EXPECT_TRUE(decision.quality);
        return decision.pauses_rendering;
    };
    EXPECT_TRUE(pauses(0, 0.9, 1, 0)) << "the first one, whose time is not known";
    EXPECT_FALSE(pauses(0, 33, 1, 0)) << "the first one of a large image";
    EXPECT_TRUE(pauses(0.2, 0.9, 2, 1));
    EXPECT_FALSE(pauses(1.5, 0.9, 2, 1)) << "on a slow machine";
    EXPECT_FALSE(pauses(0.2, 0.9, 1, 100)) << "the large network, used after a while without edits";
}

TEST(DenoiseCadence, UsesTheLargeNetworkWhenIdleAndTheBestAtTheEnd) {
    Bench bench;
    bench.warm_up();
    const double begin = bench.now;
    bench.render(1, 300);
    double spent = 0;
    for (size_t i = 0; i + 1 < bench.done.size(); ++i) {
        const double elapsed = bench.done[i].at - begin;
        const bool suffices = spent + bench.seconds[size_t(base)] <= DenoiseCadence::idle_share * elapsed;
        EXPECT_EQ(bench.done[i].quality, elapsed >= DenoiseCadence::idle_seconds && suffices ? base : fast) << i;
        spent += bench.seconds[size_t(bench.done[i].quality)];
    }
    EXPECT_EQ(bench.done[bench.done.size() - 2].quality, base);
    EXPECT_EQ(bench.done.back().quality, high);
    EXPECT_EQ(bench.done.back().samples, 300);
    EXPECT_TRUE(std::isinf(bench.cadence.next(bench.now).wait)) << "then it sleeps";
    EXPECT_FALSE(bench.cadence.next(bench.now + 1e6).quality);
}

TEST(DenoiseCadence, EnabledLateTheFastQualityComesFirst) {
    Bench bench;
    const Source source{1, 64, 1, true, 1};
    bench.offer(source);
    bench.now += 3600;
    bench.denoise_if_due(source);
    ASSERT_EQ(bench.done.size(), 2u);
    EXPECT_EQ(bench.done[0].quality, fast);
    EXPECT_EQ(bench.done[1].quality, high);
}

TEST(DenoiseCadence, APausedImageIsDenoisedWellWhenIdle) {
    Bench bench;
    const Source source{1, 5, 1, false, 1};
    bench.offer(source);
    bench.denoise_if_due(source);
    ASSERT_EQ(bench.done.size(), 1u);
    bench.idle(source);
    ASSERT_EQ(bench.done.size(), 2u) << "no further runs while paused";
    EXPECT_EQ(bench.done[1].quality, base);
}

TEST(DenoiseCadence, CoarseImagesAreDenoisedOnlyIfTheyFitAFrame) {
    const Source coarse{2, 1, 4, false, 1.0 / 16};
    for (const double megapixel_seconds : {0.1, 10.0}) {
        Bench bench;
        bench.seconds[0] = megapixel_seconds;
        bench.offer(coarse);
        EXPECT_FALSE(bench.cadence.next(bench.now).quality) << "the cost is unknown";
        EXPECT_FALSE(bench.cadence.answers_within_a_frame());
        bench.render(1, 3);
        bench.offer(coarse);
        const bool fits = megapixel_seconds / 16 < DenoiseCadence::frame_seconds;
        EXPECT_EQ(bench.cadence.answers_within_a_frame(), fits);
        EXPECT_EQ(bench.cadence.next(bench.now).quality.has_value(), fits);
        bench.denoise_if_due(coarse);
        EXPECT_FALSE(bench.cadence.answers_within_a_frame()) << "only the first frame of an image is waited for";
    }
}

TEST(DenoiseCadence, ACoarseImageThatIsFinerThanTheOneBeforeMayTakeLonger) {
    for (const double megapixel_seconds : {0.8, 10.0}) {
        Bench bench;
        bench.seconds[0] = megapixel_seconds;
        bench.warm_up();
        const Source first{1, 4, 20, false, 1.0 / 400}, finer{1, 4, 4, false, 1.0 / 16};
        bench.offer(first);
        bench.denoise_if_due(first);
        ASSERT_EQ(bench.done.size(), 1u);
        const double coarse_speed = bench.cadence.coarse_speed();
        bench.offer(finer);
        const double expected = megapixel_seconds / 16;
        ASSERT_GT(expected, DenoiseCadence::frame_seconds);
        bench.denoise_if_due(finer);
        EXPECT_EQ(bench.done.size(), expected <= DenoiseCadence::refining_seconds ? 2u : 1u) << megapixel_seconds;
        EXPECT_EQ(bench.cadence.coarse_speed(), coarse_speed) << "of first images alone";
    }
}

// Small images do not keep all cores busy, so a run takes time besides that of its pixels.
TEST(DenoiseCadence, TheTimeThatSmallImagesTakeBesidesIsNotMultiplied) {
    DenoiseCadence cadence;
    const Source full{1, 2, 1, false, 1};
    cadence.offer(full, 0);
    cadence.record(full, {fast}, 0, 0.8, true);
    cadence.offer({2, 4, 20, false, 1.0 / 400}, 1);
    cadence.record({2, 4, 20, false, 1.0 / 400}, {fast}, 1, 0.020, true); // 0.018 s more than its share of pixels
    cadence.offer({2, 4, 4, false, 1.0 / 8}, 2);
    EXPECT_TRUE(cadence.next(2).quality) << "0.1 s and 0.018 s, not 8 s a megapixel";
    cadence.offer({2, 4, 2, false, 1.0 / 4}, 2);
    EXPECT_FALSE(cadence.next(2).quality) << "0.2 s and 0.018 s";
}

TEST(DenoiseCadence, AfterACoarseImageTheFirstFullOneIsDueAtOnce) {
    Bench bench;
    bench.render(1, 3);
    const Source coarse{2, 1, 4, false, 1.0 / 16}, full{2, 1, 1, false, 1};
    bench.offer(coarse);
    bench.denoise_if_due(coarse);
    bench.offer(full);
    EXPECT_EQ(bench.cadence.next(bench.now).quality, fast);
}

TEST(DenoiseCadence, ASlowFirstRunIsIgnoredAndRisingCostIsTracked) {
    Bench bench;
    const Source coarse{2, 1, 4, false, 1.0 / 16};
    const auto coarse_fits = [&](uint64_t image) {
        Source source = coarse;
        source.image = image;
        bench.offer(source);
        return bench.cadence.answers_within_a_frame();
    };
    bench.seconds[0] = 3; // loading and building its networks
    bench.render(1, 1);
    EXPECT_FALSE(coarse_fits(2));
    bench.seconds[0] = 0.1;
    bench.render(3, 1);
    EXPECT_TRUE(coarse_fits(4));
    bench.seconds[0] = 3; // the machine is busy
    for (uint64_t image = 5; image < 15; ++image) bench.render(image, 1);
    EXPECT_FALSE(coarse_fits(20));
}

TEST(DenoiseCadence, AnUnfinishedRunIsDueAgain) {
    Bench bench;
    const Source source{1, 1, 1, false, 1};
    bench.offer(source);
    bench.cadence.record(source, {fast}, bench.now, 0.05, false);
    EXPECT_EQ(bench.cadence.next(bench.now).quality, fast);
}

TEST(DenoiseCadence, ADenoisedImageOfAnOlderImageDoesNotCount) {
    Bench bench;
    bench.offer({1, 1, 1, false, 1});
    bench.offer({2, 1, 1, false, 1});
    bench.cadence.record({1, 1, 1, false, 1}, {fast}, bench.now, 0.1, true);
    EXPECT_EQ(bench.cadence.next(bench.now).quality, fast);
}

} // namespace
} // namespace blush::TEST_FILE
