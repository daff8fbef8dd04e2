// ErrorCadence with simulated timings: no images, no clock.
#include "render/session/error_cadence.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

constexpr double pixels = 1e6, estimate_seconds = 0.01, sample_seconds = 0.1;

// Simulates rendering one sample after the other and publishing each.
struct Bench {
    ErrorCadence cadence;
    int64_t samples = 0;
    int estimates = 0;

    ErrorCadence::Source image(bool wanted = false) const { return {samples, pixels, sample_seconds * double(samples), wanted}; }
    void publish(bool wanted = false) {
        if (!cadence.due(image(wanted))) return;
        cadence.record(image(wanted), estimate_seconds);
        ++estimates;
    }
    void render(int count) {
        for (int i = 0; i < count; ++i) {
            ++samples;
            publish();
        }
    }
};

TEST(ErrorCadence, TakesAtMostItsShareOfTheTime) {
    Bench bench;
    bench.render(2); // the cost of an estimate is known after the first one
    for (int i = 0; i < 1000; ++i) {
        bench.render(1);
        const double allowed = ErrorCadence::time_share * bench.image().seconds;
        EXPECT_LE(bench.cadence.spent(), std::max(estimate_seconds, allowed + 1e-12)) << bench.samples;
    }
    EXPECT_GT(bench.estimates, 10) << "and uses most of its share";
}

TEST(ErrorCadence, EstimatesNoMoreOftenThanAPlotCanShow) {
    Bench bench;
    bench.render(100000);
    const int estimates = bench.estimates;
    bench.render(9999);
    EXPECT_LE(bench.estimates, estimates + 1) << "fewer than 10 % more samples";
}

TEST(ErrorCadence, ARequestedEstimateIsDoneAtAnyCost) {
    Bench bench;
    bench.render(3);
    const int estimates = bench.estimates;
    for (int i = 0; i < 5; ++i) bench.publish(true);
    EXPECT_EQ(bench.estimates, estimates + 5);
    EXPECT_DOUBLE_EQ(bench.cadence.spent(), estimate_seconds * bench.estimates) << "and counted";
}

TEST(ErrorCadence, NeedsTwoSamples) {
    Bench bench;
    bench.render(1);
    bench.publish(true);
    EXPECT_EQ(bench.estimates, 0);
}

// The measured cost of an estimate is kept for the next image.
TEST(ErrorCadence, ANewImageRestartsAndKeepsTheMeasuredCost) {
    Bench bench;
    bench.render(1000);
    bench.cadence.restart();
    EXPECT_EQ(bench.cadence.spent(), 0);
    bench.samples = bench.estimates = 0;
    const int affordable = int(estimate_seconds / ErrorCadence::time_share / sample_seconds + 0.5);
    bench.render(affordable - 1);
    EXPECT_EQ(bench.estimates, 0);
    bench.render(2);
    EXPECT_EQ(bench.estimates, 1);
}

} // namespace
} // namespace blush::TEST_FILE
